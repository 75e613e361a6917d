// SPDX-License-Identifier: Zlib
#include "command/accuracy/Advice.h"
#include "command/accuracy/ParetoFront.h"
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using wetcloth::Fabric;
using wetcloth::WaterPace;

/// What soaks, and how it moves.
struct Soaking {
  const char* name;
  Fabric fabric;
  bool isHung;      ///< by two corners, for six seconds; else it falls flat in still air for two
  double duration;  ///< [s]
  int side = 25;    ///< nodes along an edge
};

const std::vector<Soaking>& soakings() {
  static const std::vector<Soaking> all{{"cotton falls", Fabric::cotton(), false, 2},
                                        {"cotton is hung up in wind", Fabric::cotton(), true, 6},
                                        {"high absorption falls", Fabric::highAbsorption(), false, 2},
                                        {"high absorption is hung up in wind", Fabric::highAbsorption(), true, 6}};
  return all;
}

std::vector<Soaking> soakingsFor(const Effort& effort) {
  std::vector<Soaking> chosen = soakings();
  for (Soaking& soaking : chosen) {
    if (effort.isQuick) soaking.side = 13;
  }
  return chosen;
}

/// Height of the nodes' centre after each step [m].
using Path = std::vector<double>;

Path pathOf(const Soaking& soaking, const WaterPace& pace, double dt, double* seconds) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, soaking.side, soaking.fabric.arealDensity);
  using Corner = wetcloth::ClothPatch::Corner;
  if (soaking.isHung) settings.patch.pinnedCorners = {Corner::bottomLeft, Corner::bottomRight};
  settings.fabric = soaking.fabric;
  settings.pace = pace;
  Specimen specimen(settings);
  specimen.cloth().add<wetcloth::Absorption>();
  wetcloth::Wind::Parameters air;
  if (soaking.isHung) air.velocity = btVector3(btScalar(0.5), 0, btScalar(0.5));
  specimen.cloth().add<wetcloth::Wind>(air);
  Path heights;
  for (int i = 0; i < std::lround(soaking.duration / dt); ++i) {
    const double start = command::processorTime();
    specimen.substep(dt);
    *seconds += command::processorTime() - start;
    double height = 0;
    for (int k = 0; k < specimen.body().m_nodes.size(); ++k) height += specimen.body().m_nodes[k].m_x.y();
    heights.push_back(height / specimen.nodes());
  }
  return heights;
}

/// What the paces of one soaking are compared with: run once, when the first of them is.
class ExactPath {
 public:
  ExactPath(const Soaking& soaking, double dt) : m_soaking(soaking), m_dt(dt) {}

  const Path& heights() {
    double unused = 0;
    if (m_heights.empty()) m_heights = pathOf(m_soaking, WaterPace::exact(), m_dt, &unused);
    return m_heights;
  }

 private:
  Soaking m_soaking;
  double m_dt;
  Path m_heights;
};

/// Largest distance from the path at the exact pace, of the longest way from its beginning.
Outcome strayBy(const Soaking& soaking, const WaterPace& pace, double dt, const Path& exact) {
  Outcome outcome;
  const Path tried = pathOf(soaking, pace, dt, &outcome.seconds);
  double way = 0;
  double miss = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    way = std::max(way, std::fabs(exact[i]));
    const double distance = std::fabs(tried[i] - exact[i]);
    if (!(distance <= miss)) miss = distance;  // not std::max(), which would let NaN pass
  }
  outcome.errors = {miss / way};
  return outcome;
}

Plan planOf(const char* name, const char* title, const char* knob) {
  Plan plan;
  plan.knob = knob;
  plan.timed = "the whole step, Bullet's part included";
  plan.measures = {{name, title, "largest distance from the path, at any step, of the way",
                    "the same with water and masses in every substep"}};
  return plan;
}

void addPoint(Plan& plan, const Soaking& soaking, const WaterPace& pace, double dt,
              const std::shared_ptr<ExactPath>& exact, double knob, std::string label) {
  Setting setting;
  setting.method = soaking.name;
  setting.label = std::move(label);
  setting.knob = knob;
  setting.nodes = soaking.side * soaking.side;
  setting.steps = std::round(soaking.duration / dt);
  setting.simulatedSeconds = soaking.duration;
  setting.run = [soaking, pace, dt, exact] { return strayBy(soaking, pace, dt, exact->heights()); };
  plan.settings.push_back(std::move(setting));
}

/// The worst of all cloths at each setting, at the mean of their times.
std::vector<Point> worstOf(const std::vector<Point>& points) {
  std::vector<Point> worst;
  const double share = 1 / static_cast<double>(soakings().size());
  for (const Point& point : points) {
    const auto isSame = [&](const Point& other) { return other.label == point.label; };
    if (std::none_of(worst.begin(), worst.end(), isSame)) {
      worst.push_back(point);
      worst.back().method = "worst of the four";
      worst.back().nanosecondsPerNodeStep = worst.back().microsecondsPerNodeSecond = 0;
    }
    Point& all = *std::find_if(worst.begin(), worst.end(), isSame);
    if (!(point.error <= all.error)) all.error = point.error;  // NaN, too
    all.nanosecondsPerNodeStep += share * point.nanosecondsPerNodeStep;
    all.microsecondsPerNodeSecond += share * point.microsecondsPerNodeSecond;
  }
  return worst;
}

/// The cloths are four questions, not four ways to answer one: what is compared is the worst of them.
void compareTheWorst(Study& study) {
  const std::vector<Point> worst = worstOf(study.points);
  for (Point& point : study.points) point.isCompared = false;
  study.points.insert(study.points.end(), worst.begin(), worst.end());
  markFront(study.points);
}

/// The longest pace at which the worst of them stays within an error; "nothing" where none does.
std::string longestWithin(const Study& study, double error) {
  const Point* longest = nullptr;
  for (const Point& point : study.points) {
    const bool isGood = point.isCompared && point.error <= error;
    if (isGood && (longest == nullptr || point.knob > longest->knob)) longest = &point;
  }
  return longest == nullptr ? "nothing" : longest->label + " (" + errorText(longest->error) + ")";
}

std::vector<Study> compare(const Plan& plan, const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies = carryOut(plan, effort, tell);
  for (Study& study : studies) {
    compareTheWorst(study);
    study.advice = "All four stay within 0.1 % up to " + longestWithin(study, 1e-3) + ", within 1 % up to " +
                   longestWithin(study, 1e-2) + ".";
  }
  return studies;
}

std::vector<Study> studyRate(const Effort& effort, const TellProgress& tell) {
  constexpr double dt = 1. / 60;
  Plan plan = planOf("water_rate", "Soaking cloth whose water moves in every n-th substep of 1/60 s", "n");
  const std::vector<int> every =
      effort.isQuick ? std::vector<int>{1, 5, 25} : std::vector<int>{1, 2, 3, 4, 5, 7, 9, 15, 25};
  for (const Soaking& soaking : soakingsFor(effort)) {
    const auto exact = std::make_shared<ExactPath>(soaking, dt);
    for (const int n : every) {
      WaterPace pace = WaterPace::exact();
      pace.everySubsteps = n;
      pace.longestStep = 1;
      addPoint(plan, soaking, pace, dt, exact, n, "every " + std::to_string(n));
    }
  }
  return compare(plan, effort, tell);
}

std::vector<Study> studyTolerance(const Effort& effort, const TellProgress& tell) {
  constexpr double dt = 1. / 240;  // in a longer step a mass changes by more than most of these
  Plan plan =
      planOf("mass_tolerance", "Soaking cloth whose masses are written when one has changed, substeps of 1/240 s",
             "change of a mass that is written, of the mass");
  const std::vector<std::pair<double, const char*>> tolerances =
      effort.isQuick ? std::vector<std::pair<double, const char*>>{{1e-3, "0.1 %"}, {1e-2, "1 %"}}
                     : std::vector<std::pair<double, const char*>>{{3e-4, "0.03 %"}, {1e-3, "0.1 %"}, {2e-3, "0.2 %"},
                                                                   {5e-3, "0.5 %"},  {1e-2, "1 %"},   {3e-2, "3 %"}};
  for (const Soaking& soaking : soakingsFor(effort)) {
    const auto exact = std::make_shared<ExactPath>(soaking, dt);
    for (const auto& [tolerance, label] : tolerances) {
      WaterPace pace = WaterPace::exact();
      pace.massTolerance = tolerance;
      addPoint(plan, soaking, pace, dt, exact, tolerance, label);
    }
  }
  return compare(plan, effort, tell);
}

}  // namespace

std::vector<Study> studyPace(const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies = studyRate(effort, [&](double fraction) { tell(fraction / 2); });
  for (Study& study : studyTolerance(effort, [&](double fraction) { tell((1 + fraction) / 2); })) {
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace accuracy
