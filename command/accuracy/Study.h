// SPDX-License-Identifier: Zlib
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace accuracy {

/// How much work a study may be.
struct Effort {
  bool isQuick = false;  ///< fewer and coarser settings: for a first look and for tests
  int repeats = 3;       ///< of each setting, whose median time counts
};

/// What one run of a setting came to.
struct Outcome {
  std::vector<double> errors;  ///< one for each measure of the plan; not finite when the run has blown up
  double seconds = 0;          ///< processor time of what the plan says is timed
};

/// One way to compute what a plan asks for, at one value of its knob.
struct Setting {
  std::string method;  ///< the curve that it is a point of
  std::string label;   ///< its place on the curve
  double knob = 1;     ///< > 0
  double nodes = 1;
  double steps = 1;
  double simulatedSeconds = 1;
  std::optional<double> substep;  ///< of Bullet [s]: what a scene's quality may choose
  std::optional<int> iterations;  ///< of Bullet's position solver: the same
  bool isCompared = true;         ///< false: shows an order of convergence, and is no way to run a scene
  std::function<Outcome()> run;
};

/// One number that tells how wrong a run was.
struct Measure {
  std::string name;   ///< of the study that it becomes
  std::string title;  ///< of its plot
  std::string error;  ///< what is measured, and relative to what
  std::string reference;
  double referenceError = 0;  ///< of the reference itself, by Richardson's extrapolation; 0: a closed form
};

/// What a run does over and over, and its time is told by.
enum class Work { nodeSteps, queries };

/// Settings to run, and what to measure of each run.
struct Plan {
  std::string knob;
  std::string timed;  ///< what the time counts
  Work work = Work::nodeSteps;
  std::vector<Measure> measures;
  std::vector<Setting> settings;
};

/// "1/60 s"
std::string stepLabel(double dt);

/// Adds a curve over the step: `curve` has what its settings have in common (method, nodes, simulated seconds).
/// @param steps  [s]
void addSteps(Plan& plan, const Setting& curve, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run);

/// A setting that was run.
struct Point {
  std::string method;
  std::string label;
  double knob = 1;
  double error = 0;
  double nanosecondsPerNodeStep = 0;
  double microsecondsPerNodeSecond = 0;  ///< per node and simulated second
  std::optional<double> substep;         ///< [s]
  std::optional<int> iterations;
  bool isCompared = true;
  bool isOnFront = false;  ///< nothing else that was run is both faster and more accurate

  std::string name() const { return method + ", " + label; }
};

/// The methods of these points, each once, in their order.
std::vector<std::string> methodsOf(const std::vector<Point>& points);

/// How a method's error falls with the knob: error ~ knob^value.
struct Order {
  std::string method;
  double value = 0;
  double halfWidth = 0;  ///< of its interval of 95 %
  int points = 0;        ///< that it was fitted to
};

/// Error against time of many settings, by one measure.
struct Study {
  Measure measure;
  std::string knob;
  std::string timed;
  Work work = Work::nodeSteps;
  std::vector<Point> points;
  std::vector<Order> orders;  ///< of the methods that have enough points for one
  std::string advice;         ///< one sentence
};

/// Told how far a group of studies is, [0, 1].
using TellProgress = std::function<void(double fraction)>;

/// Runs all settings in turns, as often as the effort says, and makes a study of each measure. Times are medians.
std::vector<Study> carryOut(const Plan& plan, const Effort& effort, const TellProgress& tell);

}  // namespace accuracy
