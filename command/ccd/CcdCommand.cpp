// SPDX-License-Identifier: Zlib
#include "command/ccd/CcdCommand.h"

#include "command/ccd/CcdMethod.h"
#include "command/ccd/CcdReport.h"
#include "command/ccd/QueryFile.h"
#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace command {
namespace {

struct CcdOptions {
  std::string file;
  std::string method = "conservative";
  std::optional<double> tolerance;  ///< none: the default
  int passes = 5;
  std::string precision;  ///< of Bullet; empty: this program's
  std::string json;
  bool disagreements = false;
};

void checkQueries(const CcdOptions& options) {
  const CcdMethodInfo& method = ccdMethodNamed(options.method);
  requireCcdMethod(method, options.tolerance);
  if (options.passes < 1 || options.passes > 100) {
    throw InputError("wetcloth: --passes = " + std::to_string(options.passes) + ": must be 1 to 100");
  }
  requireDistinctFiles({{"the queries", options.file}, {"--json", options.json}});
  const std::vector<KnownQuery> queries = readQueries(options.file);
  JsonOutput output(options.json);
  CcdReport report(method, options.tolerance, options.passes);
  for (const auto pair : {wetcloth::collision::Pair::vertexFace, wetcloth::collision::Pair::edgeEdge}) {
    report.add(pair, queries);
  }
  output.write(report.json(options.disagreements));
  if (!output.ownsStandardOutput()) std::fputs(report.table(options.disagreements).c_str(), stdout);
}

}  // namespace

Command addCcdCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("ccd", "Count and time what a collision check gets wrong");
  const auto options = std::make_shared<CcdOptions>();
  std::vector<std::string> methods;
  std::string guarantees;
  for (const CcdMethodInfo& method : ccdMethods()) {
    methods.push_back(method.name);
    guarantees += (guarantees.empty() ? "" : ". ") + method.name + ": " + method.guarantee;
  }
  app->add_option("queries", options->file,
                  "Queries with their exact answers, as CSV (or that in gzip): id, scene, type (vf or ee), truth (1 or "
                  "0), x, y, z of the four points at the start and at the end")
      ->required();
  app->add_option("--method", options->method, guarantees)->check(oneOf("--method", methods))->capture_default_str();
  app->add_option("--tolerance", options->tolerance,
                  "fast, conservative, exact: width in time below which a contact is not looked for more closely; "
                  "textbook, newton: how far outside still counts; bullet has none. Default 1e-6");
  app->add_option("--passes", options->passes, "Everything is timed so often, and the median counts")
      ->capture_default_str();
  addPrecision(*app, options->precision);
  addJson(*app, options->json);
  app->add_flag("--disagreements", options->disagreements, "Name the queries that are answered wrongly");
  return {app, [options] { checkQueries(*options); }, [options] { return wishOf(options->precision); }};
}

}  // namespace command
