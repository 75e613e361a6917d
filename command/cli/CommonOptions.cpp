// SPDX-License-Identifier: Zlib
#include "command/cli/CommonOptions.h"

#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"

#include <algorithm>

namespace command {

CLI::Validator oneOf(const std::string& option, const std::vector<std::string>& words) {
  const auto check = [option, words](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return "";
    throw InputError("wetcloth: " + option + " = \"" + word + "\": " + didYouMean(word, words) + "must be one of " +
                     joined(words));
  };
  return CLI::Validator(check, joined(words), "one of");
}

void addJson(CLI::App& app, std::string& target, const std::string& what) {
  app.add_option("--json", target, "File for " + what + " as JSON; - is standard output, with nothing else");
}

void addPrecision(CLI::App& app, std::string& precision, const std::string& explanation) {
  app.add_option("--precision", precision, explanation)->check(oneOf("--precision", namesOf(precisionNames())));
}

PrecisionWish wishOf(const std::string& precision) {
  if (precision.empty()) return {};
  return {valueOf(precisionNames(), precision), "wetcloth: --precision"};
}

}  // namespace command
