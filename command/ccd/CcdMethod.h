// SPDX-License-Identifier: Zlib
#pragma once

#include "command/ccd/QueryFile.h"

#include <bullet_wetcloth/collision/Query.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace command {

/// A way to answer collision queries, with those it is to answer.
class CcdMethod {
 public:
  virtual ~CcdMethod() = default;

  virtual std::size_t count() const = 0;
  /// How many queries are to be answered in one call: 1, but for a method made for batches.
  virtual std::size_t batch() const { return 1; }
  /// Answers queries first .. first + count - 1 into contacts[0 .. count - 1].
  virtual void answer(std::size_t first, std::size_t count, wetcloth::collision::Contact* contacts) const = 0;
};

/// What there is to know about a method before it answers anything.
struct CcdMethodInfo {
  enum class Kind { fast, conservative, exact, bullet, textbook, newton };
  enum class Tolerance { none, time, inside };

  Kind kind;
  std::string name;
  std::string guarantee;  ///< what its answers are worth, in one line
  Tolerance tolerance;    ///< what its tolerance is about
};

const std::vector<CcdMethodInfo>& ccdMethods();
const CcdMethodInfo& ccdMethodNamed(const std::string& name);
constexpr double defaultCcdTolerance = 1e-6;

/// The method, given these queries of one kind; null when it has no check for that kind.
/// Throws InputError when it is not in this build or the tolerance is out of its range.
std::unique_ptr<CcdMethod> makeCcdMethod(const CcdMethodInfo& info, std::optional<double> tolerance,
                                         wetcloth::collision::Pair pair, const std::vector<KnownQuery>& queries);

/// The same complaints without any queries, before a long file is read.
void requireCcdMethod(const CcdMethodInfo& info, std::optional<double> tolerance);

}  // namespace command
