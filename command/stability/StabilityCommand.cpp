// SPDX-License-Identifier: Zlib
#include "command/stability/StabilityCommand.h"

#include "command/stability/MarkedSection.h"
#include "command/stability/StabilityReport.h"
#include "command/stability/StabilityRun.h"
#include "command/stability/StabilityTable.h"
#include "command/stability/StoredOutcomes.h"
#include "command/stability/World.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/cli/StagedOutput.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stability {
namespace {

struct StabilityOptions {
  std::string name;       ///< of a case; empty: all
  std::string group;      ///< empty: all
  std::string world;      ///< empty: all
  std::string step;       ///< "1/240" or "0.004" [s]; empty: all of the table
  std::string precision;  ///< empty: this program's
  bool isQuick = false;
  std::string json;
  std::string markdown;
  std::string outcomes;
};

constexpr double smallestStep = 1e-4;
constexpr double largestStep = 1;

/// A number without anything before or behind it.
std::optional<double> numberIn(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size()) return std::nullopt;
  return number;
}

std::optional<double> stepIn(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t slash = text.find('/');
  std::optional<double> step = numberIn(text.substr(0, slash));
  if (step && slash != std::string::npos) {
    const std::optional<double> divisor = numberIn(text.substr(slash + 1));
    step = divisor ? std::optional<double>(*step / *divisor) : std::nullopt;
  }
  if (step && *step >= smallestStep && *step <= largestStep) return step;
  throw command::InputError("wetcloth: --step = \"" + text + "\": must be in [0.0001, 1] s, as 0.01 or 1/100");
}

Selection selectionOf(const StabilityOptions& options) {
  Selection selection;
  selection.name = options.name;
  selection.group = options.group;
  if (!options.world.empty()) selection.world = command::valueOf(stabilityWorlds(), options.world);
  selection.step = stepIn(options.step);
  selection.effort = options.isQuick ? Effort::quick : Effort::full;
  return selection;
}

void write(const StoredOutcomes& outcomes, command::StagedOutput& output) {
  std::ofstream(output.path()) << outcomes.text();
  output.commit();
}

void tryHardCases(const StabilityOptions& options) {
  const Selection selection = selectionOf(options);
  const std::vector<Combination> combinations = combinationsOf(selection);
  if (combinations.empty()) {
    throw command::InputError("wetcloth: no case is left by --case, --group, --world and --quick together");
  }
  command::JsonOutput output(options.json);
  std::optional<MarkedSection> section;
  if (!options.markdown.empty()) {
    section.emplace(options.markdown, "stability " + command::nameOf(command::ownPrecision));
  }
  std::optional<command::StagedOutput> outcomes;
  if (!options.outcomes.empty()) {
    outcomes.emplace("wetcloth: --outcomes = \"" + options.outcomes + "\"", options.outcomes,
                     command::StagedOutput::Kind::file);
  }
  std::vector<CaseResult> results;
  {
    command::Progress progress("trying " + std::to_string(combinations.size()) + " hard cases");
    results = runCombinations(combinations, selection.effort, [&](double done) { progress.update(done); });
  }
  if (outcomes) write(StoredOutcomes(results), *outcomes);
  const StabilityReport report(std::move(results));
  output.write(report.json());
  if (section) section->write(report.markdown());
  if (!output.ownsStandardOutput()) std::fputs(report.text().c_str(), stdout);
  if (report.count(CaseResult::Verdict::fails) > 0) {
    throw command::RunError("wetcloth: a bound does not hold, and plain Bullet holds it: " + report.failing());
  }
}

}  // namespace

command::Command addStabilityCommand(CLI::App& line) {
  using command::oneOf;
  CLI::App* const app =
      line.add_subcommand("stability", "Try hard cases, each long enough to blow up, against the bounds of physics");
  const auto options = std::make_shared<StabilityOptions>();
  app->add_option("--case", options->name, "One of them; default is all of docs/stability.md")
      ->check(oneOf("--case", caseNames()));
  app->add_option("--group", options->group, "One group of them")->check(oneOf("--group", groupNames()));
  app->add_option("--world", options->world, "Bullet's world; none: the cases that need no world")
      ->check(oneOf("--world", command::namesOf(stabilityWorlds())));
  app->add_option("--step", options->step, "One step [s], 0.01 or 1/100, instead of 1/1000, 1/240, 1/60, 1/30, 1/10");
  command::addPrecision(*app, options->precision);
  app->add_flag("--quick", options->isQuick, "Only the steps 1/240 s and 1/30 s, and a minute of laundry");
  command::addJson(*app, options->json);
  app->add_option("--markdown", options->markdown,
                  "File in which the table is written between the lines <!-- stability PRECISION --> and <!-- end of "
                  "stability PRECISION -->");
  app->add_option("--outcomes", options->outcomes,
                  "File, which is replaced, for what came of each run: tests/hard_cases/outcomes_PRECISION.txt");
  return {app, [options] { tryHardCases(*options); }, [options] { return command::wishOf(options->precision); }};
}

}  // namespace stability
