// SPDX-License-Identifier: Zlib
#include "command/stability/StabilityReport.h"

#include "command/stability/StabilityTable.h"

#include "command/scene/Scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <utility>

namespace stability {
namespace {

using Json = nlohmann::ordered_json;
using Verdict = CaseResult::Verdict;

std::string numberText(double number) {
  if (!std::isfinite(number)) return "inf";
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

/// JSON has no infinity: null.
Json marginJson(const CaseMeter& meter) {
  const double ratio = meter.nearest().ratio;
  return std::isfinite(ratio) ? Json(ratio) : Json();
}

Json comparisonJson(const std::optional<CaseMeter>& meter, const std::string& name) {
  if (!meter) return Json();
  Json json;
  if (!name.empty()) json["name"] = name;
  json["verdict"] = meter->holds() ? "holds" : "fails";
  json["margin"] = marginJson(*meter);
  json["bound"] = meter->nearest().bound;
  return json;
}

std::string comparisonText(const std::optional<CaseMeter>& meter) {
  if (!meter) return "";
  return (meter->holds() ? "holds " : "fails ") + numberText(meter->nearest().ratio) +
         (meter->holds() ? "" : " " + meter->nearest().bound);
}

std::string cell(const CaseResult& result) {
  const std::string margin = numberText(result.ours.nearest().ratio);
  switch (result.verdict()) {
    case Verdict::holds: return margin;
    case Verdict::fails: return "**fails** " + result.ours.nearest().bound + " " + margin;
    case Verdict::bulletFails: break;
  }
  return "Bullet: " + result.ours.nearest().bound;
}

std::vector<double> stepsOf(const std::vector<CaseResult>& results) {
  std::set<double> steps;
  for (const CaseResult& result : results) {
    if (result.step > 0) steps.insert(result.step);
  }
  return {steps.begin(), steps.end()};
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& one : cells) text += " " + one + " |";
  return text + "\n";
}

std::string tableHead(const std::vector<std::string>& names) {
  return row(names) + row(std::vector<std::string>(names.size(), "---"));
}

std::vector<std::string> withStepNames(std::vector<std::string> names, const std::vector<double>& steps) {
  for (const double step : steps) names.push_back(stepName(step) + " s");
  return names;
}

/// In how many of the cases that run in a world at a step every bound holds.
std::string worldTable(const std::vector<CaseResult>& results, const std::vector<double>& steps) {
  std::string text = tableHead(withStepNames({"world"}, steps));
  for (const auto& [name, world] : stabilityWorlds()) {
    std::map<double, std::pair<int, int>> counts;
    for (const CaseResult& result : results) {
      if (result.world != world || result.step == 0) continue;
      ++counts[result.step].second;
      if (result.verdict() == Verdict::holds) ++counts[result.step].first;
    }
    if (counts.empty()) continue;
    std::vector<std::string> cells{name};
    for (const double step : steps) {
      cells.push_back(std::to_string(counts[step].first) + " of " + std::to_string(counts[step].second));
    }
    text += row(cells);
  }
  return text;
}

std::string caseTable(const std::vector<CaseResult>& results, const std::vector<double>& steps) {
  std::string text = tableHead(withStepNames({"case", "world"}, steps));
  for (std::size_t first = 0; first < results.size();) {
    std::vector<std::string> cells(2 + steps.size());
    cells[0] = "`" + results[first].hardCase->name + "`";
    cells[1] = nameOf(results[first].world);
    std::size_t next = first;
    for (; next < results.size() && results[next].hardCase == results[first].hardCase &&
           results[next].world == results[first].world;
         ++next) {
      const auto at = std::find(steps.begin(), steps.end(), results[next].step);
      const auto column = at == steps.end() ? 0 : at - steps.begin();
      if (!steps.empty()) cells[2 + static_cast<std::size_t>(column)] = cell(results[next]);
    }
    text += row(cells);
    first = next;
  }
  return text;
}

std::string naiveTable(const std::vector<CaseResult>& results, const std::vector<double>& steps) {
  std::string text = tableHead(withStepNames({"case", "world", "the obvious way"}, steps));
  std::vector<std::string> cells;
  const HardCase* previous = nullptr;
  World previousWorld = World::none;
  for (const CaseResult& result : results) {
    if (!result.naiveMethod) continue;
    if (result.hardCase != previous || result.world != previousWorld) {
      if (!cells.empty()) text += row(cells);
      cells = {"`" + result.hardCase->name + "`", nameOf(result.world), result.hardCase->naiveMethod};
      cells.resize(3 + std::max<std::size_t>(1, steps.size()));
      previous = result.hardCase;
      previousWorld = result.world;
    }
    const auto at = std::find(steps.begin(), steps.end(), result.step);
    const auto column = at == steps.end() ? 0 : at - steps.begin();
    cells[3 + static_cast<std::size_t>(column)] = comparisonText(result.naiveMethod);
  }
  return cells.empty() ? "" : text + row(cells);
}

}  // namespace

std::string StabilityReport::text() const {
  char line[256];
  std::string text;
  std::snprintf(line, sizeof line, "%-32s %-23s %8s  %-12s %8s  %-14s %-28s %s\n", "case", "world", "step [s]",
                "verdict", "margin", "bound", "plain Bullet", "obvious way");
  text += line;
  for (const CaseResult& result : m_results) {
    const std::string naive =
        result.naiveMethod ? result.hardCase->naiveMethod + ": " + comparisonText(result.naiveMethod) : "";
    std::snprintf(line, sizeof line, "%-32s %-23s %8s  %-12s %8s  %-14s %-28s %s\n", result.hardCase->name.c_str(),
                  nameOf(result.world).c_str(), stepName(result.step).c_str(), nameOf(result.verdict()),
                  numberText(result.ours.nearest().ratio).c_str(), result.ours.nearest().bound.c_str(),
                  comparisonText(result.plainBullet).c_str(), naive.c_str());
    text += line;
  }
  std::snprintf(line, sizeof line,
                "\n%zu runs in %s: %d hold, %d fail, in %d Bullet itself is what fails.\nMargin: measured / allowed of "
                "the bound that is nearest; up to 1 holds.\n",
                m_results.size(), command::nameOf(command::ownPrecision).c_str(), count(Verdict::holds),
                count(Verdict::fails), count(Verdict::bulletFails));
  return text + line;
}

Json StabilityReport::json() const {
  Json cases = Json::array();
  for (const CaseResult& result : m_results) {
    cases.push_back({{"name", result.hardCase->name},
                     {"group", result.hardCase->group},
                     {"about", result.hardCase->about},
                     {"world", nameOf(result.world)},
                     {"precision", command::nameOf(command::ownPrecision)},
                     {"step", result.step},
                     {"verdict", nameOf(result.verdict())},
                     {"margin", marginJson(result.ours)},
                     {"bound", result.ours.nearest().bound},
                     {"plain_bullet", comparisonJson(result.plainBullet, "")},
                     {"obvious_way", comparisonJson(result.naiveMethod, result.hardCase->naiveMethod)}});
  }
  return {{"precision", command::nameOf(command::ownPrecision)},
          {"holds", count(Verdict::holds)},
          {"fails", count(Verdict::fails)},
          {"bullet_fails", count(Verdict::bulletFails)},
          {"cases", std::move(cases)}};
}

std::string StabilityReport::markdown() const {
  const std::vector<double> steps = stepsOf(m_results);
  std::string text = "\nCases in which every bound holds, " + command::nameOf(command::ownPrecision) + ":\n\n";
  text += worldTable(m_results, steps);
  text +=
      "\nThe margin of each, measured / allowed of the nearest bound; `Bullet:` and a bound where Bullet alone fails, "
      "too:\n\n";
  text += caseTable(m_results, steps);
  const std::string naive = naiveTable(m_results, steps);
  if (!naive.empty()) text += "\nWhat the obvious way does:\n\n" + naive;
  return text + "\n";
}

int StabilityReport::count(Verdict verdict) const {
  return static_cast<int>(std::count_if(m_results.begin(), m_results.end(),
                                        [=](const CaseResult& result) { return result.verdict() == verdict; }));
}

std::string StabilityReport::failing() const {
  std::set<std::string> names;
  for (const CaseResult& result : m_results) {
    if (result.verdict() == Verdict::fails) names.insert(result.hardCase->name);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace stability
