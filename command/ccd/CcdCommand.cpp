// SPDX-License-Identifier: Zlib
#include "command/ccd/CcdCommand.h"

#include "command/ccd/CcdMethod.h"
#include "command/ccd/CcdReport.h"
#include "command/ccd/QueryFile.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/Sibling.h"

#include <cstdio>
#include <vector>

namespace command {

void checkQueries(const CcdOptions& options, char** arguments) {
  const CcdMethodInfo& method = ccdMethodNamed(options.method);
  requireCcdMethod(method, options.tolerance);
  if (options.passes < 1 || options.passes > 100) {
    throw InputError("wetcloth: --passes = " + std::to_string(options.passes) + ": must be 1 to 100");
  }
  if (!options.precision.empty()) {
    continueInPrecision(valueOf(precisionNames(), options.precision), "wetcloth: --precision", arguments);
  }
  const std::vector<KnownQuery> queries = readQueries(options.file);
  JsonOutput output(options.json);
  CcdReport report(method, options.tolerance, options.passes);
  for (const auto pair : {wetcloth::collision::Pair::vertexFace, wetcloth::collision::Pair::edgeEdge}) {
    report.add(pair, queries);
  }
  output.write(report.json(options.disagreements));
  if (!output.ownsStandardOutput()) std::fputs(report.table(options.disagreements).c_str(), stdout);
}

}  // namespace command
