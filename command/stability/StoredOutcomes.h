// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseRun.h"

#include <map>
#include <string>
#include <vector>

namespace stability {

/// What is known to come of the hard cases, in a file: tests/hard_cases/outcomes_PRECISION.txt has them all. "Bullet
/// fails as well" excuses nothing that did hold before.
///
/// A line for each case in a world, "CASE WORLD STEP VERDICT STEP VERDICT ...": `wind_50 soft_rigid 1/60 holds`. Lines
/// that begin with # are remarks.
class StoredOutcomes {
 public:
  using Verdict = CaseResult::Verdict;

  /// Throws InputError when the file cannot be read or a line of it is not as above.
  static StoredOutcomes read(const std::string& file);
  explicit StoredOutcomes(const std::vector<CaseResult>& results);

  /// What is worse than stored, or not stored at all, in a line for people; empty: nothing.
  std::string complaintAbout(const CaseResult& result) const;
  std::size_t count() const { return m_verdicts.size(); }

  /// As the file has it.
  std::string text() const;

 private:
  struct Run {
    std::string hardCase;
    std::string world;
    std::string step;
    bool operator<(const Run& other) const;
  };

  StoredOutcomes() = default;
  void readLine(const std::string& line);
  void add(const Run& run, Verdict verdict);
  static Run runOf(const CaseResult& result);

  std::map<Run, Verdict> m_verdicts;
  std::vector<Run> m_order;  // of the table
};

}  // namespace stability
