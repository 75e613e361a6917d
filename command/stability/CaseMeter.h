// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace stability {

/// How near a run came to each of its bounds.
class CaseMeter {
 public:
  struct Margin {
    std::string bound;
    double ratio;  ///< worst measured / allowed: up to 1 holds; infinite for what is not a number
  };

  /// Compares a measured value, >= 0, with what is allowed. Where nothing is allowed (0), only 0 holds.
  void compare(const char* bound, double measured, double allowed);

  const std::vector<Margin>& margins() const { return m_margins; }
  /// The margin of this name; 0 when it was never compared.
  double marginOf(const std::string& bound) const;
  /// The largest of all, which a bound holds when it is at most 1. Never empty: `finite` is there from the beginning.
  const Margin& nearest() const;
  bool holds() const { return nearest().ratio <= 1; }

 private:
  std::vector<Margin> m_margins = {{"finite", 0}};
};

}  // namespace stability
