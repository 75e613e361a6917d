// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseRun.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace stability {

/// The results of the table, for people and for programs.
class StabilityReport {
 public:
  explicit StabilityReport(std::vector<CaseResult> results) : m_results(std::move(results)) {}

  /// One row for each case, world and step.
  std::string text() const;
  nlohmann::ordered_json json() const;
  /// One row for each case and world, a column for each step; then what the naive methods and plain Bullet fail.
  std::string markdown() const;

  int count(CaseResult::Verdict verdict) const;
  /// Names of the cases with a verdict `fails`, separated by commas.
  std::string failing() const;

 private:
  std::vector<CaseResult> m_results;
};

}  // namespace stability
