// SPDX-License-Identifier: Zlib
#include "command/fall/FallCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Progress.h"
#include "command/fall/Fall.h"
#include "command/scene/Scene.h"
#include "command/scene/SolverOption.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

namespace command {
namespace {

struct FallOptions {
  std::optional<double> height;  ///< [m]; none: the mode's own
  std::string mode = "paper";
  std::string world = "soft_rigid";
  std::string solver = "bullet";
  std::string precision;  ///< empty: this program's
  std::string json;
};

constexpr double highest = 1000;  // a fall from higher takes this command more than a minute

double heightOf(const FallOptions& options, const FallMode& mode) {
  const double height = options.height.value_or(mode.defaultHeight);
  if (height > 0 && height <= highest) return height;
  char text[128];
  std::snprintf(text, sizeof text, "wetcloth: --height = %g: must be finite, > 0 and at most %g m", height, highest);
  throw InputError(text);
}

nlohmann::ordered_json jsonOf(const std::vector<FallResult>& results) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const FallResult& result : results) {
    cases.push_back({{"name", result.name},
                     {"wet_dry_mass_ratio", result.massRatio},
                     {"time_s", result.time},
                     {"closed_form_s", result.closedForm},
                     {"fps", result.fps}});
  }
  return cases;
}

void printTable(const std::vector<FallResult>& results, const FallMode& mode, double height, const std::string& world,
                const std::string& solver) {
  std::printf("A level cloth of 32 x 32 nodes falls %g m (%s mode, %s, solver %s, %s, substeps of 1/240 s).\n\n",
              height, mode.name.c_str(), world.c_str(), solver.c_str(), nameOf(ownPrecision).c_str());
  std::printf("%-10s  %12s  %9s  %13s  %10s  %9s\n", "case", "mass wet/dry", "time", "closed form", "error",
              "frames/s");
  for (const FallResult& result : results) {
    std::printf("%-10s  %12.2f  %7.3f s  %11.3f s  %7.2f ms  %9.0f\n", result.name.c_str(), result.massRatio,
                result.time, result.closedForm, 1e3 * (result.time - result.closedForm), result.fps);
  }
  std::printf("\n%s\n", mode.remark.c_str());
}

void compareFalls(const FallOptions& options) {
  const FallMode mode = options.mode == "paper" ? FallMode::paper() : FallMode::physical();
  const double height = heightOf(options, mode);
  const WorldKind world = valueOf(worldNames(), options.world);
  std::optional<wetcloth::ClothSolver::Parameters> clothSolver;
  applySolver(options.solver, world, clothSolver);
  JsonOutput output(options.json);
  std::vector<FallResult> results;
  {
    Progress progress("falling");
    for (const FallMode::Case& fallCase : mode.cases) {
      results.push_back(fall(mode, fallCase, height, world, clothSolver));
      progress.update(static_cast<double>(results.size()) / static_cast<double>(mode.cases.size()));
    }
  }
  output.write({{"mode", mode.name},
                {"height_m", height},
                {"world", options.world},
                {"solver", options.solver},
                {"precision", nameOf(ownPrecision)},
                {"dt", fallSubstep},
                {"cases", jsonOf(results)}});
  if (!output.ownsStandardOutput()) printTable(results, mode, height, options.world, options.solver);
}

}  // namespace

Command addFallCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("fall", "Let dry and wet cloth fall, beside plain Bullet");
  const auto options = std::make_shared<FallOptions>();
  app->add_option("--height", options->height, "Height of the fall [m]; default 19.62 (paper), 5.5 (physical)");
  app->add_option("--mode", options->mode,
                  "paper: Table II, up to 84 times as heavy, drag linear in speed; physical: cotton, quadratic drag")
      ->check(oneOf("--mode", {"paper", "physical"}))
      ->capture_default_str();
  app->add_option("--world", options->world, "Which of Bullet's worlds")
      ->check(oneOf("--world", namesOf(worldNames())))
      ->capture_default_str();
  addSolver(*app, options->solver, "Who steps the cloth, but in plain Bullet; wetcloth in the first two worlds");
  addPrecision(*app, options->precision);
  addJson(*app, options->json);
  return {app, [options] { compareFalls(*options); }, [options] { return wishOf(options->precision); }};
}

}  // namespace command
