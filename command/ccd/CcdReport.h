// SPDX-License-Identifier: Zlib
#pragma once

#include "command/ccd/CcdMethod.h"
#include "command/ccd/CcdTiming.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace command {

/// How a method did against the exact answers of a file.
class CcdReport {
 public:
  CcdReport(const CcdMethodInfo& method, std::optional<double> tolerance, int passes)
      : m_method(method), m_tolerance(tolerance.value_or(defaultCcdTolerance)), m_passes(passes) {}

  /// Lets the method answer the queries of one kind.
  void add(wetcloth::collision::Pair pair, const std::vector<KnownQuery>& queries);

  nlohmann::ordered_json json(bool withDisagreements) const;
  /// The same for people.
  std::string table(bool withDisagreements) const;

 private:
  struct Row {
    std::string type;  ///< as in the file: vf or ee
    std::size_t queries = 0;
    std::size_t contacts = 0;
    bool isAnswered = false;  ///< false: the method has no check of this type
    std::size_t batch = 1;    ///< queries that were timed together
    std::vector<std::string> missed;
    std::vector<std::string> falseAlarms;
    CcdTimes times;
  };

  /// Of the rows that are answered.
  Row total() const;
  static nlohmann::ordered_json jsonOf(const Row& row);
  static std::string lineOf(const Row& row);
  std::string heading() const;

  const CcdMethodInfo& m_method;
  double m_tolerance;
  int m_passes;
  std::vector<Row> m_rows;
};

}  // namespace command
