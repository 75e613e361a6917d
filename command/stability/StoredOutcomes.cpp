// SPDX-License-Identifier: Zlib
#include "command/stability/StoredOutcomes.h"

#include "command/stability/StabilityTable.h"

#include "command/cli/Errors.h"
#include "command/cli/NamedValues.h"
#include "command/cli/TextFile.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace stability {
namespace {

using Verdict = CaseResult::Verdict;

const command::NamedValues<Verdict>& verdictNames() {
  static const command::NamedValues<Verdict> names{{nameOf(Verdict::holds), Verdict::holds},
                                                   {nameOf(Verdict::bulletFails), Verdict::bulletFails},
                                                   {nameOf(Verdict::fails), Verdict::fails}};
  return names;
}

/// By how bad they are.
int rankOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return 0;
    case Verdict::bulletFails: return 1;
    case Verdict::fails: break;
  }
  return 2;
}

Verdict verdictNamed(const std::string& name) {
  const std::vector<std::string> names = command::namesOf(verdictNames());
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw std::invalid_argument("\"" + name + "\" is no verdict");
  }
  return command::valueOf(verdictNames(), name);
}

}  // namespace

bool StoredOutcomes::Run::operator<(const Run& other) const {
  return std::tie(hardCase, world, step) < std::tie(other.hardCase, other.world, other.step);
}

StoredOutcomes::StoredOutcomes(const std::vector<CaseResult>& results) {
  for (const CaseResult& result : results) add(runOf(result), result.verdict());
}

StoredOutcomes StoredOutcomes::read(const std::string& file) {
  StoredOutcomes outcomes;
  std::string line;
  try {
    std::istringstream lines(command::readTextFile(file));
    while (std::getline(lines, line)) outcomes.readLine(line);
  } catch (const std::invalid_argument& error) {
    throw command::InputError(command::onOneLine(file + ": " + (line.empty() ? "" : line + ": ") + error.what()));
  }
  return outcomes;
}

void StoredOutcomes::readLine(const std::string& line) {
  if (line.empty() || line[0] == '#') return;
  std::istringstream words(line);
  Run run;
  words >> run.hardCase >> run.world;
  std::string verdict;
  while (words >> run.step) {
    if (!(words >> verdict)) throw std::invalid_argument("a step without a verdict");
    add(run, verdictNamed(verdict));
  }
  if (run.step.empty()) throw std::invalid_argument("must be CASE WORLD STEP VERDICT ...");
}

void StoredOutcomes::add(const Run& run, Verdict verdict) {
  if (!m_verdicts.emplace(run, verdict).second) throw std::invalid_argument("is there twice");
  m_order.push_back(run);
}

StoredOutcomes::Run StoredOutcomes::runOf(const CaseResult& result) {
  return {result.hardCase->name, nameOf(result.world), stepName(result.world == World::none ? 0 : result.step)};
}

std::string StoredOutcomes::complaintAbout(const CaseResult& result) const {
  const Run run = runOf(result);
  const std::string what = run.hardCase + " in " + run.world + " at " + run.step + " s: ";
  const auto stored = m_verdicts.find(run);
  if (stored == m_verdicts.end()) return what + "not stored";
  if (rankOf(result.verdict()) <= rankOf(stored->second)) return "";
  return what + nameOf(result.verdict()) + ", stored: " + nameOf(stored->second);
}

std::string StoredOutcomes::text() const {
  std::string text = "# What came of the hard cases; written by `wetcloth stability --outcomes`.";
  const Run* previous = nullptr;
  for (const Run& run : m_order) {
    const bool isSameLine = previous != nullptr && previous->hardCase == run.hardCase && previous->world == run.world;
    if (!isSameLine) text += "\n" + run.hardCase + " " + run.world;
    text += " " + run.step + " " + nameOf(m_verdicts.at(run));
    previous = &run;
  }
  return text + "\n";
}

}  // namespace stability
