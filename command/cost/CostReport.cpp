// SPDX-License-Identifier: Zlib
#include "command/cost/CostReport.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace command {
namespace {

double floorOf(const CostEstimate& twins) { return std::max(std::fabs(twins.median), twins.halfWidth); }

constexpr const char* tableLegend =
    "Each effect is toggled: what a world with all effects takes in its steps more than one without this effect, the\n"
    "worlds taking turns in one run; medians, of processor time, over groups of steps in which water moves once. \"ns\n"
    "per node\" and \"% of Bullet's step\" count our own part of the step, of the guard, which is in the solver, the\n"
    "whole, \"mean\" also what is done in some steps only; \"whole step\" has what the effect makes Bullet do, and\n"
    "Bullet's noise. \"< x\": not to be told from "
    "nothing,\n"
    "where x is what two identical worlds differ by or the\n"
    "median's interval of 95 %, the larger of the two.\n";

/// A number beside what could be told at all, which it is not when it is less.
std::string withNoise(const CostReport::Finding& finding) {
  char text[64];
  const int decimals = finding.noise < 1 ? 2 : 1;
  if (finding.isBelowNoise()) {
    std::snprintf(text, sizeof text, "< %.*f", decimals, finding.noise);
  } else {
    std::snprintf(text, sizeof text, "%.*f +- %.*f", decimals, finding.value, decimals, finding.noise);
  }
  return text;
}

}  // namespace

CostReport::CostReport(const CostRun& run)
    : m_run(run),
      m_bullet(estimate(run.plain().step).median),
      m_oursFloor(floorOf(estimateDifference(run.all().ours, run.twin().ours))),
      m_wholeFloor(floorOf(estimateDifference(run.all().step, run.twin().step))),
      m_idleRatio(estimateRatio(run.idle().step, run.plain().step)),
      m_all{"all", estimate(run.all().ours), estimateDifference(run.all().step, run.plain().step), m_oursFloor} {
  for (std::size_t i = 0; i < run.effects().size(); ++i) {
    const CostRun::Samples& without = run.without(i);
    const CostEstimate whole = estimateDifference(run.all().step, without.step);
    const bool isGuard = run.effects()[i] == CostWorld::guard;
    const CostEstimate ours = isGuard ? whole : estimateDifference(run.all().ours, without.ours);
    m_effects.push_back({run.effects()[i], ours, whole, isGuard ? m_wholeFloor : m_oursFloor});
  }
}

CostReport::Finding CostReport::percent(const CostEstimate& difference, double floor) const {
  return {100 * difference.median / m_bullet, 100 * std::max(floor, difference.halfWidth) / m_bullet};
}

/// Slower or faster: an idle cloth that seems faster than Bullet is noise, too.
CostReport::Finding CostReport::idlePercent() const {
  return {100 * std::fabs(m_idleRatio.median - 1), 100 * std::max(m_idleRatio.halfWidth, m_wholeFloor / m_bullet)};
}

nlohmann::ordered_json CostReport::jsonOf(const Cost& cost) const {
  const Finding ours = oursPercent(cost);
  const Finding whole = wholePercent(cost);
  return {{"name", cost.name},
          {"ns_per_node", nanosecondsPerNode(std::max(0.0, cost.ours.median))},
          {"percent_of_step", std::max(0.0, ours.value)},
          {"noise_percent", ours.noise},
          {"below_noise", ours.isBelowNoise()},
          {"mean_ns_per_node", nanosecondsPerNode(std::max(0.0, cost.ours.mean))},
          {"mean_noise_ns_per_node", nanosecondsPerNode(cost.ours.meanHalfWidth)},
          {"whole_step_percent", whole.value},
          {"whole_step_noise_percent", whole.noise}};
}

nlohmann::ordered_json CostReport::json() const {
  const Scene& scene = m_run.scene();
  nlohmann::ordered_json json;
  json["scene"] = scene.name;
  json["world"] = nameOf(scene.world);
  json["precision"] = nameOf(ownPrecision);
  json["solver"] = nameOf(scene.solver());
  json["nodes"] = m_run.nodes();
  json["steps"] = m_run.steps();
  json["dt"] = scene.step;
  json["iterations"] = scene.iterations;
  json["worlds"] = m_run.worlds();
  if (!m_run.obstacle().empty()) json["stopped"] = m_run.obstacle();
  json["baseline_ns_per_node"] = nanosecondsPerNode(m_bullet);
  json["noise_percent"] = 100 * m_oursFloor / m_bullet;
  json["no_effects_ratio"] = m_idleRatio.median;
  json["no_effects_percent"] = idlePercent().isBelowNoise() ? 0 : std::max(0.0, 100 * (m_idleRatio.median - 1));
  json["no_effects_noise_percent"] = idlePercent().noise;
  if (!scene.clothSolver) json["no_effects_same_state"] = m_run.isIdleSameAsPlain();
  json["all_effects_ns_per_node"] = nanosecondsPerNode(m_all.ours.median);
  json["all_effects_percent"] = oursPercent(m_all).value;
  json["all_effects_whole_step_percent"] = wholePercent(m_all).value;
  json["effects"] = nlohmann::ordered_json::array();
  for (const Cost& cost : m_effects) json["effects"].push_back(jsonOf(cost));
  return json;
}

std::string CostReport::head() const {
  const Scene& scene = m_run.scene();
  const Finding idle = idlePercent();
  char difference[64];
  std::snprintf(difference, sizeof difference,
                idle.isBelowNoise() ? "within the noise (%.2f %%)" : "more than the noise (%.2f %%)", idle.noise);
  char text[1200];
  std::snprintf(text, sizeof text,
                "%-15s%s (%s, %s), %d nodes\n"
                "%-15s%d of Bullet's, %.4g s each with %d iterations; %d worlds in turns, the first step not counted\n"
                "%-15s%.1f ns per node and step (%.3f ms)\n"
                "%-15s%.4f of plain Bullet's step, %s; %s\n",
                "scene", scene.name.c_str(), nameOf(scene.world).c_str(), nameOf(ownPrecision).c_str(), m_run.nodes(),
                "steps", m_run.steps(), scene.step, scene.iterations, m_run.worlds(), "plain Bullet",
                nanosecondsPerNode(m_bullet), 1e3 * m_bullet, "no effects", m_idleRatio.median, difference,
                scene.clothSolver           ? "on the solver wetcloth"
                : m_run.isIdleSameAsPlain() ? "the same state"
                                            : "ANOTHER STATE");
  return text;
}

std::string CostReport::row(const Cost& cost) const {
  const Finding ours = oursPercent(cost);
  const double scale = nanosecondsPerNode(m_bullet) / 100;
  const Finding mean{nanosecondsPerNode(cost.ours.mean), nanosecondsPerNode(cost.ours.meanHalfWidth)};
  char text[240];
  std::snprintf(text, sizeof text, "%-18s  %16s  %16s  %18s  %18s\n", cost.name.c_str(),
                withNoise({ours.value * scale, ours.noise * scale}).c_str(), withNoise(mean).c_str(),
                withNoise(ours).c_str(), withNoise(wholePercent(cost)).c_str());
  return text;
}

std::string CostReport::text() const {
  std::string text = head();
  if (!m_run.obstacle().empty()) text += "stopped        " + m_run.obstacle() + "\n";
  if (m_effects.empty()) return text + "The scene has no effects.\n";
  char title[240];
  std::snprintf(title, sizeof title, "\n%-18s  %16s  %16s  %18s  %18s\n", "effect", "ns per node", "mean",
                "% of Bullet's step", "whole step, %");
  text += title;
  for (const Cost& cost : m_effects) text += row(cost);
  return text + row(m_all) + "\n" + tableLegend;
}

}  // namespace command
