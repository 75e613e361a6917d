// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Keeps what flows between nodes within what they hold and can hold.
///
/// A set of fluxes whose sum leaves every node within bounds is taken as it is. Otherwise what enters the nodes that
/// would be over-full, and what leaves those that would be overdrawn, is scaled down a few times; and if that was not
/// enough, every node gives at most what it holds and takes at most what it has room for, whatever the others do
/// (Zalesak 1979, "Fully multidimensional flux-corrected transport algorithms for fluids", his factors R+ and R-).
class FluxLimiter {
 public:
  /// For that many nodes. Allocates.
  void reset(std::size_t nodeCount);

  /// Scales fluxes down, each by a factor in [0, 1], and carries them out: afterwards 0 <= held <= capacity. A node
  /// that was over-full stays at or below what it held. The sum of held is kept to rounding. For any fluxes; those that
  /// are NaN count as 0.
  /// @param fluxes  from a to b of each edge [kg]
  /// @param capacity, held  of each node [kg]
  void apply(const std::vector<WeightedEdge>& edges, const std::vector<double>& capacity, std::vector<double>& fluxes,
             std::vector<double>& held);

 private:
  struct Sums {
    double in;
    double out;
  };
  struct Node {
    double ceiling;    // what it may hold afterwards
    double takeShare;  // R+
    double giveShare;  // R-
  };

  void sumFluxes(const std::vector<WeightedEdge>& edges, std::vector<double>& fluxes);
  bool findOffenders(const std::vector<double>& held);
  void findSafeShares(const std::vector<double>& held);
  void scale(const std::vector<WeightedEdge>& edges, std::vector<double>& fluxes) const;

  std::vector<Sums> m_sums;  // of the fluxes of each node
  std::vector<Node> m_nodes;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
