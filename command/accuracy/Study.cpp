// SPDX-License-Identifier: Zlib
#include "command/accuracy/Study.h"

#include "command/accuracy/Advice.h"
#include "command/accuracy/ConvergenceOrder.h"
#include "command/accuracy/ParetoFront.h"
#include "command/timing/ProcessorTime.h"
#include "command/timing/Quantile.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace accuracy {
namespace {

/// A run that is so long is steady enough, and three of them would be most of the time of all studies [s].
constexpr double longRun = 4;

struct Runs {
  std::vector<double> errors;
  std::vector<double> seconds;
};

/// In turns, so that whatever else the machine does slows all settings alike.
std::vector<Runs> runInTurns(const Plan& plan, const Effort& effort, const TellProgress& tell) {
  std::vector<Runs> runs(plan.settings.size());
  double done = 0;
  for (int repeat = 0; repeat < effort.repeats; ++repeat) {
    for (std::size_t i = 0; i < plan.settings.size(); ++i) {
      if (runs[i].seconds.empty() || runs[i].seconds.front() < longRun) {
        Outcome outcome = plan.settings[i].run();
        // All repeats come to the same result.
        runs[i].errors = std::move(outcome.errors);
        runs[i].seconds.push_back(outcome.seconds);
      }
      done += 1;
      tell(done / (static_cast<double>(plan.settings.size()) * effort.repeats));
    }
  }
  return runs;
}

Point pointOf(const Setting& setting, double error, double seconds) {
  Point point;
  point.method = setting.method;
  point.label = setting.label;
  point.knob = setting.knob;
  point.error = error;
  point.nanosecondsPerNodeStep = 1e9 * seconds / (setting.nodes * setting.steps);
  point.microsecondsPerNodeSecond = 1e6 * seconds / (setting.nodes * setting.simulatedSeconds);
  point.substep = setting.substep;
  point.iterations = setting.iterations;
  point.isCompared = setting.isCompared;
  return point;
}

}  // namespace

std::vector<std::string> methodsOf(const std::vector<Point>& points) {
  std::vector<std::string> methods;
  for (const Point& point : points) {
    if (std::find(methods.begin(), methods.end(), point.method) == methods.end()) methods.push_back(point.method);
  }
  return methods;
}

std::string stepLabel(double dt) {
  char text[32];
  if (dt < 1) {
    std::snprintf(text, sizeof text, "1/%.4g s", 1 / dt);
  } else {
    std::snprintf(text, sizeof text, "%.4g s", dt);
  }
  return text;
}

void addSteps(Plan& plan, const Setting& curve, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run) {
  for (const double dt : steps) {
    Setting setting = curve;
    setting.label = stepLabel(dt);
    setting.knob = setting.substep.emplace(dt);
    setting.steps = curve.simulatedSeconds / dt;
    setting.run = [run, dt] { return run(dt); };
    plan.settings.push_back(std::move(setting));
  }
}

std::vector<Study> carryOut(const Plan& plan, const Effort& effort, const TellProgress& tell) {
  const std::vector<Runs> runs = runInTurns(plan, effort, tell);
  std::vector<Study> studies;
  for (std::size_t measure = 0; measure < plan.measures.size(); ++measure) {
    Study study;
    study.measure = plan.measures[measure];
    study.knob = plan.knob;
    study.timed = plan.timed;
    study.work = plan.work;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const double seconds = command::atLeastATick(command::median(runs[i].seconds));
      study.points.push_back(pointOf(plan.settings[i], runs[i].errors.at(measure), seconds));
    }
    markFront(study.points);
    study.orders = ordersOf(study.points, study.measure.referenceError);
    study.advice = adviceOn(study.points);
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace accuracy
