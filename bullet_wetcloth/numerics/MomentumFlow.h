// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Velocities after water has flowed between nodes, each portion with the velocity of the node that it leaves.
///
/// Upwind: while no node gives more than it weighs, all water leaves with the velocities before,
/// (m - out + in) v' = (m - out) v + sum of in v_from. Otherwise implicit: (m + in) v' = m v + sum of in v'_from, in
/// the order in which the water flows, so one pass solves it; where water goes round in a circle, the nodes that it
/// reaches end at one velocity. Each v' is a mean of velocities there were, for any flux, however large against the
/// nodes' masses, and the momentum of all nodes is kept.
class MomentumFlow {
 public:
  struct Node {
    std::array<double, 3> velocity;  ///< [m/s], before and after
    double mass;                     ///< before [kg]
    bool isFixed;                    ///< keeps its velocity
  };

  /// For that many nodes. Allocates.
  void reset(std::size_t nodeCount, const std::vector<WeightedEdge>& edges);

  /// Changes the velocities. @param fluxes from a to b of each edge [kg]
  void apply(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes, std::vector<Node>& nodes);

 private:
  struct Inflow {
    std::array<double, 3> momentum;  // of what came in, relative to the node before [kg m/s]
    double mass;
    double out;   // what went out [kg]
    int pending;  // edges through which water has yet to come
  };

  bool mixAtOnce(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes, std::vector<Node>& nodes);
  void mixInOrder(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes, std::vector<Node>& nodes);
  void countInflows(const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes);
  void passOn(int from, const std::vector<WeightedEdge>& edges, const std::vector<double>& fluxes,
              const std::vector<Node>& nodes);
  void stirCircles(std::vector<Node>& nodes);

  std::vector<Inflow> m_inflows;
  std::vector<int> m_ready;  // nodes that all water has reached
  std::vector<std::size_t> m_firstEdge;
  std::vector<int> m_edgesOfNode;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
