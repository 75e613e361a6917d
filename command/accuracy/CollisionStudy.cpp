// SPDX-License-Identifier: Zlib
#include "command/accuracy/Studies.h"

#include "command/ccd/CcdMethod.h"
#include "command/ccd/CcdTiming.h"
#include "command/ccd/QueryFile.h"
#include "command/cli/Errors.h"
#include "command/cli/ProgramFolder.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using wetcloth::collision::Pair;

/// Of the data that go with the command
constexpr const char* queryFile = "ccd/real_queries.csv.gz";

struct Tier {
  const char* method;
  std::optional<double> tolerance;
};

std::vector<Tier> tiers(const Effort& effort) {
  if (effort.isQuick) return {{"fast", {}}, {"conservative", {}}, {"textbook", {}}, {"bullet", {}}};
  return {{"fast", 1e-3},         {"fast", 1e-6},         {"fast", 1e-9},     {"conservative", 1e-3},
          {"conservative", 1e-6}, {"conservative", 1e-9}, {"exact", {}},      {"bullet", {}},
          {"textbook", 1e-9},     {"textbook", 1e-6},     {"textbook", 1e-3}, {"newton", 1e-6}};
}

std::vector<command::KnownQuery> ofPair(const std::vector<command::KnownQuery>& all, Pair pair) {
  std::vector<command::KnownQuery> some;
  for (const command::KnownQuery& query : all) {
    if (query.pair == pair) some.push_back(query);
  }
  return some;
}

/// Shares of the contacts that were missed and of the others that were called contacts.
std::vector<double> wrongShares(const command::CcdMethod& method, const std::vector<command::KnownQuery>& queries) {
  std::vector<wetcloth::collision::Contact> contacts(queries.size());
  for (std::size_t first = 0; first < queries.size(); first += method.batch()) {
    method.answer(first, std::min(method.batch(), queries.size() - first), &contacts[first]);
  }
  double meeting = 0;
  double missed = 0;
  double alarms = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    meeting += queries[i].meets ? 1 : 0;
    missed += queries[i].meets && !contacts[i].found ? 1 : 0;
    alarms += !queries[i].meets && contacts[i].found ? 1 : 0;
  }
  const double apart = static_cast<double>(queries.size()) - meeting;
  return {meeting > 0 ? missed / meeting : 0, apart > 0 ? alarms / apart : 0};
}

/// None where the method has no such check, or is not in this build.
std::optional<Setting> settingOf(const Tier& tier, Pair pair, const std::vector<command::KnownQuery>& queries) {
  std::shared_ptr<command::CcdMethod> method;
  try {
    method = command::makeCcdMethod(command::ccdMethodNamed(tier.method), tier.tolerance, pair, queries);
  } catch (const command::InputError&) {
    return std::nullopt;
  }
  if (!method) return std::nullopt;
  Setting setting;
  setting.method = tier.method;
  setting.label = "default tolerance";
  if (tier.tolerance) {
    char text[32];
    std::snprintf(text, sizeof text, "tolerance %.0e", *tier.tolerance);
    setting.label = text;
    setting.knob = *tier.tolerance;
  }
  if (setting.method == "exact" || setting.method == "bullet") setting.label = "no tolerance";
  const double count = static_cast<double>(queries.size());
  setting.nodes = count;
  setting.run = [method, &queries, count] {
    return Outcome{wrongShares(*method, queries), 1e-9 * command::timeOf(*method, 1).mean * count};
  };
  return setting;
}

std::vector<Study> studyPair(Pair pair, const std::string& word, const std::string& kind, const Effort& effort,
                             const TellProgress& tell) {
  const std::vector<command::KnownQuery> queries = ofPair(command::readQueries(command::dataFile(queryFile)), pair);
  const std::string count = std::to_string(queries.size());
  Plan plan;
  plan.knob = "tolerance";
  plan.timed = "one query";
  plan.work = Work::queries;
  plan.measures = {{"collision_missed_" + word, "Missed contacts of " + kind + ", " + count + " queries",
                    "false negatives, of the queries that meet", "exact answers in rational numbers"},
                   {"collision_alarms_" + word, "False alarms of " + kind + ", " + count + " queries",
                    "false positives, of the queries that do not meet", "exact answers in rational numbers"}};
  for (const Tier& tier : tiers(effort)) {
    if (std::optional<Setting> setting = settingOf(tier, pair, queries)) plan.settings.push_back(std::move(*setting));
  }
  std::vector<Study> studies = carryOut(plan, effort, tell);
  // A tolerance is no step: the share of wrong answers has no order of convergence.
  for (Study& study : studies) study.orders.clear();
  return studies;
}

}  // namespace

std::vector<Study> studyCollision(const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies =
      studyPair(Pair::vertexFace, "vf", "vertices with faces", effort, [&](double fraction) { tell(fraction / 2); });
  for (Study& study : studyPair(Pair::edgeEdge, "ee", "edges with edges", effort,
                                [&](double fraction) { tell(0.5 + fraction / 2); })) {
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace accuracy
