// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/scene/Twist.h"
#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using Guard = std::optional<wetcloth::ClothSolver::Guard>;

constexpr double guardedStep = 1. / 60;

Specimen::Settings guardedBy(const Guard& guard, wetcloth::ClothPatch patch) {
  Specimen::Settings settings;
  settings.patch = std::move(patch);
  settings.world.clothSolver.emplace();
  settings.world.clothSolver->guard = guard;
  return settings;
}

/// Kinetic and of gravity [J].
double energyOf(const btSoftBody& body) {
  double energy = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im > 0) energy += (double(node.m_v.length2()) / 2 + 9.81 * double(node.m_x.y())) / double(node.m_im);
  }
  return energy;
}

double longestLinkOf(const btSoftBody& body) {
  double longest = 0;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    longest = std::max(longest, double((link.m_n[0]->m_x - link.m_n[1]->m_x).length() / link.m_rl));
  }
  return longest;
}

/// A run is timed without an audit, and made once more with one.
enum class Purpose { timing, counting };

class GuardedRun {
 public:
  GuardedRun(Specimen& specimen, Purpose purpose) : m_specimen(specimen) {
    if (purpose == Purpose::counting) m_audit = &specimen.cloth().add<wetcloth::CollisionAudit>();
  }
  void step() {
    const double start = command::processorTime();
    m_specimen.substep(guardedStep);
    m_seconds += command::processorTime() - start;
  }
  /// 0 without an audit.
  double passages() {
    if (m_audit == nullptr) return 0;
    m_audit->look();
    return static_cast<double>(m_audit->totals().passages());
  }
  double seconds() const { return m_seconds; }

 private:
  Specimen& m_specimen;
  wetcloth::CollisionAudit* m_audit = nullptr;
  double m_seconds = 0;
};

struct GuardedScene {
  int side;         ///< nodes
  double duration;  ///< [s]
  Outcome (*run)(const GuardedScene& scene, const Guard& guard, Purpose purpose);
};

/// A sheet with waves, dropped on its edge. Passages, and the energy that came from nowhere, of that at the beginning.
Outcome dropHeap(const GuardedScene& scene, const Guard& guard, Purpose purpose) {
  wetcloth::ClothPatch patch = levelSquare(1, scene.side);
  patch.edgeV = btVector3(0, 1, 0);
  patch.origin.setY(btScalar(0.05));
  Specimen specimen(guardedBy(guard, patch));
  btSoftBody& body = specimen.body();
  body.m_cfg.kDF = btScalar(0.5);
  body.getCollisionShape()->setMargin(btScalar(0.01));
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btVector3& x = body.m_nodes[i].m_x;
    x.setZ(btScalar(0.01 * std::sin(15 * (double(x.y()) - 0.05) + 2 * double(x.x()))));
    body.m_nodes[i].m_q = x;
  }
  specimen.addFloor();
  GuardedRun run(specimen, purpose);
  const double atStart = energyOf(body);
  double before = atStart;
  double gained = 0;
  for (int i = 0; i < std::lround(scene.duration / guardedStep); ++i) {
    run.step();
    const double now = energyOf(body);
    gained += std::max(0., now - before);
    before = now;
  }
  return {{run.passages(), gained / atStart}, run.seconds()};
}

/// A towel that is wrung two turns by rods that come together. Passages, and how much longer a link gets.
Outcome wring(const GuardedScene& scene, const Guard& guard, Purpose purpose) {
  wetcloth::ClothPatch patch = levelSquare(0.9, scene.side);
  patch.edgeV = btVector3(0, 0, btScalar(0.35));
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
  Specimen specimen(guardedBy(guard, patch));
  command::TwistScene turning;
  turning.edge = wetcloth::ClothPatch::Edge::right;
  turning.turns = 2;
  turning.turnsPerSecond = turning.turns / scene.duration;
  turning.approach = 0.4;
  command::Twist twist(specimen.body(), patch, turning);
  GuardedRun run(specimen, purpose);
  double longest = 1;
  for (int i = 0; i < std::lround(scene.duration / guardedStep); ++i) {
    twist.moveTo((i + 1) * guardedStep);
    run.step();
    longest = std::max(longest, longestLinkOf(specimen.body()));
  }
  return {{run.passages(), longest - 1}, run.seconds()};
}

struct Choice {
  std::string method;
  std::string label;
  Guard guard;
};

std::vector<Choice> choices(const Effort& effort) {
  std::vector<Choice> all{{"no guard", "layers pass", std::nullopt}};
  for (const int every : effort.isQuick ? std::vector<int>{1, 10} : std::vector<int>{1, 2, 5, 10, 20}) {
    wetcloth::ClothSolver::Guard guard;
    guard.every = every;
    all.push_back({"2 mm thick", "looks " + std::to_string(every) + " small steps ahead", guard});
  }
  for (const double millimetres : effort.isQuick ? std::vector<double>{0} : std::vector<double>{0, 0.5, 5, 10}) {
    wetcloth::ClothSolver::Guard guard;
    guard.thickness = millimetres / 1000;
    char label[32];
    std::snprintf(label, sizeof label, "%g mm thick", millimetres);
    all.push_back({"looks 10 small steps ahead", label, guard});
  }
  return all;
}

std::vector<Study> compareGuards(const GuardedScene& scene, const Measure& passages, const Measure& price,
                                 const Effort& effort, const TellProgress& tell) {
  Plan plan;
  plan.knob = "none";
  plan.timed = "the whole step";
  plan.measures = {passages, price};
  const auto unguarded = std::make_shared<std::optional<double>>();  // run once, when the first of them is
  for (const Choice& choice : choices(effort)) {
    Setting setting;
    setting.method = choice.method;
    setting.label = choice.label;
    setting.nodes = scene.side * scene.side;
    setting.steps = std::round(scene.duration / guardedStep);
    setting.simulatedSeconds = scene.duration;
    setting.isCompared = choice.guard.has_value();
    setting.run = [=] {
      if (!*unguarded) *unguarded = scene.run(scene, std::nullopt, Purpose::counting).errors[0];
      Outcome outcome = scene.run(scene, choice.guard, Purpose::counting);
      outcome.errors[0] /= **unguarded;
      outcome.seconds = scene.run(scene, choice.guard, Purpose::timing).seconds;
      return outcome;
    };
    plan.settings.push_back(std::move(setting));
  }
  std::vector<Study> studies = carryOut(plan, effort, tell);
  for (Study& one : studies) one.orders.clear();  // neither knob is a step
  return studies;
}

const char* const counted = "passages that CollisionAudit counts, of those without a guard";

}  // namespace

std::vector<Study> studyGuard(const Effort& effort, const TellProgress& tell) {
  const GuardedScene heap{effort.isQuick ? 13 : 25, effort.isQuick ? 0.8 : 3., dropHeap};
  const GuardedScene wrung{effort.isQuick ? 9 : 25, effort.isQuick ? 2. : 3., wring};
  std::vector<Study> studies =
      compareGuards(heap, {"guard_heap", "What passes in a heap", counted, "nothing passes"},
                    {"guard_energy", "Energy that appears in a heap",
                     "sum of all rises of energy, of that at the start", "nothing puts energy in"},
                    effort, [&](double fraction) { tell(fraction / 2); });
  for (Study& one : compareGuards(wrung, {"guard_wring", "What passes in a wrung towel", counted, "nothing passes"},
                                  {"guard_stretch", "Stretch of a wrung towel",
                                   "longest link over its length at rest, less 1", "links do not stretch"},
                                  effort, [&](double fraction) { tell((1 + fraction) / 2); })) {
    studies.push_back(std::move(one));
  }
  return studies;
}

}  // namespace accuracy
