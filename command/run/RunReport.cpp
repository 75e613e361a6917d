// SPDX-License-Identifier: Zlib
#include "command/run/RunReport.h"

#include "command/cli/NearestWord.h"
#include "command/run/StateHash.h"
#include "command/scene/Quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace command {
namespace {

// They have all looked at the same time.
std::optional<wetcloth::AuditTotals> sumOf(const std::vector<wetcloth::CollisionAudit*>& audits) {
  std::optional<wetcloth::AuditTotals> sum;
  for (const wetcloth::CollisionAudit* audit : audits) {
    const wetcloth::AuditTotals totals = audit->totals();
    if (!sum) sum.emplace();
    sum->vertexFace += totals.vertexFace;
    sum->edgeEdge += totals.edgeEdge;
    sum->candidatePairs += totals.candidatePairs;
    sum->incompleteSubsteps = std::max(sum->incompleteSubsteps, totals.incompleteSubsteps);
    sum->substeps = std::max(sum->substeps, totals.substeps);
    sum->seconds = std::max(sum->seconds, totals.seconds);
  }
  return sum;
}

/// To a tenth of a gram, and no "-0.0" for what rounding has left below nothing.
double tenthsOfGrams(double kilograms) {
  const double tenths = std::round(1e4 * kilograms);
  return tenths == 0 ? 0 : tenths / 10;
}

}  // namespace

RunReport::RunReport(const SceneWorld& world, const RunTimes& times, const DripRecord& drips)
    : m_scene(world.scene()),
      m_times(times),
      m_hash(stateHash(world)),
      m_drips(drips),
      m_audit(sumOf(world.audits())),
      m_saturation(saturationOf(world)) {
  for (const btSoftBody* body : world.bodies()) measureBody(*body);
  for (const wetcloth::WetCloth* cloth : world.cloths()) measureCloth(*cloth);
  for (const auto& springs : world.springs()) {
    if (springs) m_springs.push_back(springs->stiffness);
  }
  if (world.drops() != nullptr) m_drops = world.drops()->ledger();
  askSolver(world);
}

void RunReport::askSolver(const SceneWorld& world) {
  if (world.clothSolver() == nullptr) return;
  m_guard = world.clothSolver()->guardTotals();
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    const std::string reason = world.clothSolver()->reasonNotTaken(*world.bodies()[i]);
    if (!reason.empty()) m_solverReasons.emplace_back("/cloths/" + std::to_string(i), reason);
  }
}

void RunReport::measureBody(const btSoftBody& body) {
  m_nodes += body.m_nodes.size();
  m_links += body.m_links.size();
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    m_maxSpeed = std::max(m_maxSpeed, static_cast<double>(body.m_nodes[i].m_v.length()));
  }
  for (int i = 0; i < body.m_links.size(); ++i) {
    const btSoftBody::Link& link = body.m_links[i];
    const btScalar length = (link.m_n[1]->m_x - link.m_n[0]->m_x).length();
    if (link.m_rl > 0) m_maxStretch = std::max(m_maxStretch, static_cast<double>(length / link.m_rl));
  }
}

void RunReport::measureCloth(const wetcloth::WetCloth& cloth) {
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const double mass = cloth.dryMass(i) + cloth.held(i);
    m_mass += mass;
    for (int axis = 0; axis < 3; ++axis)
      m_moment[axis] += mass * static_cast<double>(cloth.body().m_nodes[i].m_x[axis]);
  }
  const wetcloth::Ledger ledger = cloth.ledger();
  m_ledger.initial += ledger.initial;
  m_ledger.absorbed += ledger.absorbed;
  m_ledger.evaporated += ledger.evaporated;
  m_ledger.dripped += ledger.dripped;
  m_ledger.held += ledger.held;
  m_ledger.runOff += ledger.runOff;
  for (const wetcloth::Effect& effect : cloth.effects()) {
    if (std::find(m_effects.begin(), m_effects.end(), effect.name()) == m_effects.end()) {
      m_effects.emplace_back(effect.name());
    }
  }
}

nlohmann::ordered_json RunReport::json() const {
  nlohmann::ordered_json json;
  json["scene"] = m_scene.name;
  json["file"] = m_scene.file;
  json["world"] = nameOf(m_scene.world);
  json["precision"] = nameOf(ownPrecision);
  json["quality"] = qualityOf(m_scene);
  json["steps"] = m_times.steps;
  json["dt"] = m_scene.step;
  json["substeps"] = m_scene.substeps;
  json["iterations"] = m_scene.iterations;
  json["solver"] = nameOf(m_scene.solver());
  if (m_scene.clothSolver) json["small_steps"] = m_scene.clothSolver->smallSteps;
  for (const auto& [cloth, reason] : m_solverReasons) json["solver_reasons"][cloth] = reason;
  if (m_stepping) {
    for (const SteppingChoice::Expectation& expectation : m_stepping->expected) {
      json["expected_errors"][expectation.study.study] = expectation.error;
    }
  }
  json["nodes"] = m_nodes;
  json["links"] = m_links;
  json["effects"] = m_effects;
  json["wall_ms_per_step"] = m_times.wetMilliseconds;
  if (m_times.plainMilliseconds) json["bullet_ms_per_step"] = *m_times.plainMilliseconds;
  json["ledger"] = {{"initial", m_ledger.initial}, {"absorbed", m_ledger.absorbed}, {"evaporated", m_ledger.evaporated},
                    {"dripped", m_ledger.dripped}, {"held", m_ledger.held},         {"run_off", m_ledger.runOff}};
  if (m_drips.isOn()) json["drips"] = m_drips.json();
  if (m_drops) {
    json["drops"] = {{"initial", m_drops->initial},       {"absorbed", m_drops->absorbed},
                     {"brought", m_drops->brought},       {"held", m_drops->held},
                     {"in_flight", m_drops->inFlight},    {"films", m_drops->films},
                     {"evaporated", m_drops->evaporated}, {"left", m_drops->left},
                     {"imbalance", m_drops->imbalance()}};
  }
  json["saturation"] = {{"min", m_saturation.min}, {"mean", m_saturation.mean}, {"max", m_saturation.max}};
  if (m_audit) {
    json["audit"] = {{"vertex_face", m_audit->vertexFace},
                     {"edge_edge", m_audit->edgeEdge},
                     {"per_second", m_audit->perSecond()},
                     {"incomplete_substeps", m_audit->incompleteSubsteps}};
  }
  if (hasGuard()) {
    json["guard"] = {{"passages", m_guard.forced},
                     {"stopped", m_guard.stopped},
                     {"halts", m_guard.halts},
                     {"meeting", m_guard.meeting},
                     {"crossing", m_guard.crossing}};
    if (m_guard.stopped > 0) {
      const btVector3& place = m_guard.placeOfMost;
      json["guard"]["longest_stop_s"] = m_guard.longestStop;
      json["guard"]["most_stopped"] = {{"nodes", m_guard.mostStopped},
                                       {"position_m", {place.x(), place.y(), place.z()}}};
    }
    if (m_scene.clothSolver->guard->bodies) json["guard"]["inside"] = m_guard.inside;
  }
  json["centre_of_mass"] = {m_moment[0] / m_mass, m_moment[1] / m_mass, m_moment[2] / m_mass};
  json["max_speed"] = m_maxSpeed;
  if (!m_springs.empty()) json["springs_n_m"] = m_springs;
  json["max_stretch"] = m_maxStretch;
  json["state_hash"] = m_hash;
  return json;
}

/// The time that a step takes over the time that it simulates: at most 1 keeps up.
double RunReport::ofRealTime() const { return m_times.wetMilliseconds / (1e3 * m_scene.step); }

std::string RunReport::timeLine() const {
  char text[120];
  std::snprintf(text, sizeof text, "%-15s%.3f ms per step, %.2f of real time", "time", m_times.wetMilliseconds,
                ofRealTime());
  std::string line = text;
  if (m_times.plainMilliseconds) {
    const double plain = *m_times.plainMilliseconds;
    std::snprintf(text, sizeof text, "; plain Bullet %.3f ms (ratio %.2f)", plain,
                  plain > 0 ? m_times.wetMilliseconds / plain : 0.);
    line += text;
  }
  return line + "\n";
}

std::string RunReport::waterLines() const {
  char text[240];
  std::snprintf(text, sizeof text, "%-15s%.1f g held = %.1f initial + %.1f absorbed - %.1f dripped - %.1f evaporated\n",
                "water", tenthsOfGrams(m_ledger.held), tenthsOfGrams(m_ledger.initial),
                tenthsOfGrams(m_ledger.absorbed), tenthsOfGrams(m_ledger.dripped), tenthsOfGrams(m_ledger.evaporated));
  std::string lines = text + m_drips.line();
  if (m_drops) {
    std::snprintf(text, sizeof text, "%-15s%.1f g brought; %.1f g in flight, %.1f g on bodies, %.1f g left\n", "drops",
                  tenthsOfGrams(m_drops->brought), tenthsOfGrams(m_drops->inFlight), tenthsOfGrams(m_drops->films),
                  tenthsOfGrams(m_drops->left));
    lines += text;
  }
  if (m_ledger.runOff > 0) {
    std::snprintf(text, sizeof text, "%-15s%.3g g struck the cloth and were not taken in\n", "run-off",
                  1e3 * m_ledger.runOff);
    lines += text;
  }
  return lines;
}

std::string RunReport::steppingLine() const {
  if (!m_stepping) return "";
  std::string line;
  for (const SteppingChoice::Expectation& expectation : m_stepping->expected) {
    char text[120];
    std::snprintf(text, sizeof text, "%s%s %.2g %%", line.empty() ? "" : ", ", expectation.study.study.c_str(),
                  100 * expectation.error);
    line += text;
  }
  return "measured error " + line + "\n";
}

std::string RunReport::stopsLine() const {
  if (m_guard.stopped == 0) return "";
  char text[160];
  const btVector3& place = m_guard.placeOfMost;
  std::snprintf(text, sizeof text, "               at most %lld at once, near (%.2f, %.2f, %.2f) m; one for %.2g s\n",
                m_guard.mostStopped, double(place.x()), double(place.y()), double(place.z()), m_guard.longestStop);
  return text;
}

std::string RunReport::solverLine() const {
  if (!m_scene.clothSolver) return "";
  std::string line =
      "solver         wetcloth, " + std::to_string(m_scene.clothSolver->smallSteps) + " small steps in 1/60 s\n";
  if (hasGuard()) {
    line += "guard          " + std::to_string(m_guard.forced) + " pairs forced through each other, " +
            std::to_string(m_guard.stopped) + " nodes slowed, " + std::to_string(m_guard.halts) +
            " small steps in which all stood still\n" + stopsLine();
  }
  for (const auto& [cloth, reason] : m_solverReasons) {
    line.append("               Bullet's own steps ").append(cloth).append(": ").append(reason).append("\n");
  }
  return line;
}

std::string RunReport::springsLine() const {
  if (m_springs.empty()) return "";
  std::string line;
  for (const double stiffness : m_springs) {
    char text[40];
    std::snprintf(text, sizeof text, "%s%.3g N/m", line.empty() ? "" : ", ", stiffness);
    line += text;
  }
  return "springs        " + line + " (spring_stiffness_n_m)\n";
}

std::string RunReport::auditLine() const {
  if (!m_audit) return "";
  char text[200];
  std::snprintf(text, sizeof text, "%-15s%lld vertices through faces, %lld edges through edges (%.4g per second)\n",
                "passages", m_audit->vertexFace, m_audit->edgeEdge, m_audit->perSecond());
  return text;
}

std::string RunReport::summary() const {
  char text[1600];
  std::snprintf(text, sizeof text,
                "%-15s%s (%s, %s, %s)\n"
                "%-15s%d of %.4g s (%.4g s), each %d substeps of %d iterations\n"
                "%-15s%d nodes, %d links\n"
                "%-15s%s\n"
                "%s%s"
                "%-15s%.2f to %.2f, mean %.2f\n"
                "%-15s(%.3f, %.3f, %.3f) m\n"
                "%-15sspeed %.3g m/s, link length %.3f of its rest length\n"
                "%-15s%s\n",
                "scene", m_scene.name.c_str(), nameOf(m_scene.world).c_str(), nameOf(ownPrecision).c_str(),
                qualityOf(m_scene).c_str(), "steps", m_times.steps, m_scene.step, m_times.steps * m_scene.step,
                m_scene.substeps, m_scene.iterations, "mesh", m_nodes, m_links, "effects",
                m_effects.empty() ? "none" : joined(m_effects).c_str(), timeLine().c_str(), waterLines().c_str(),
                "saturation", m_saturation.min, m_saturation.max, m_saturation.mean, "centre of mass",
                m_moment[0] / m_mass, m_moment[1] / m_mass, m_moment[2] / m_mass, "largest", m_maxSpeed, m_maxStretch,
                "state hash", m_hash.c_str());
  return text + solverLine() + springsLine() + steppingLine() + auditLine();
}

}  // namespace command
