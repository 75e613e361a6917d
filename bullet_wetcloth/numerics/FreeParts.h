// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/SpringEnergy.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The parts of a net that springs hold together and nothing holds in place. Springs do not move their centre of mass,
/// however far a solver has come.
class FreeParts {
 public:
  /// Finds them. Nodes without an inertia are held.
  void find(const std::vector<Spring>& springs, const SpringEnergy& energy);
  /// Moves each as a whole so that its centre of mass is that of its inertial positions.
  void centre(const SpringEnergy& energy, std::vector<std::array<double, 3>>& positions);

 private:
  static constexpr std::size_t kHeld = ~std::size_t(0);

  struct Balance {
    std::array<double, 3> moment;
    double inertia;
  };

  std::vector<std::size_t> m_part;  // of a node
  std::vector<Balance> m_balances;  // of a part
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
