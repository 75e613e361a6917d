// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"
#include "bullet_wetcloth/numerics/FluxLimiter.h"
#include "bullet_wetcloth/numerics/MomentumFlow.h"
#include "bullet_wetcloth/water/Water.h"

#include <BulletSoftBody/btSoftBody.h>
#include <LinearMath/btVector3.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Water that flows along the edges of a cloth: what the effects of the stage `transport` have in common.
///
/// load() reads the cloth's water, limit() carries out fluxes on that copy, and commit() hands the outcome to the cloth
/// with the momentum that moved.
class EdgeFlow {
 public:
  /// For these edges, whose weights are those of delaunayWeights(). Allocates.
  void reset(const RestMesh& mesh, std::vector<WeightedEdge> edges);

  /// Reads capacities and held water. Returns whether capacities, and so conductances, are others than before.
  bool load(const Water& water);

  std::size_t nodeCount() const { return m_held.size(); }
  /// Weights are the conductances: weight times capacity per area, the harmonic mean of both ends' [kg/m^2].
  const std::vector<WeightedEdge>& edges() const { return m_edges; }
  const std::vector<double>& capacities() const { return m_capacity; }
  /// At most 1: what an over-full node holds beyond its capacity neither drives nor hinders a flow.
  double saturation(std::size_t node) const {
    return m_held[node] < m_capacity[node] ? m_held[node] / m_capacity[node] : 1;
  }

  /// Carries out fluxes from a to b of each edge [kg] as far as nodes can give and take: see FluxLimiter.
  void limit(std::vector<double>& fluxes) { m_limiter.apply(m_edges, m_capacity, fluxes, m_held); }

  /// Water that has left its node since load() [kg].
  double moved() const;

  bool hasMoved() const { return m_held != m_before; }

  /// Moves the cloth's water, and gives the nodes the velocity that comes with it, by push(node, change of velocity).
  /// `fluxes` is the sum of those that went through limit() since load(). What arrived in this step must have joined
  /// its nodes: WetCloth::joinArrivals().
  template <class Push>
  void commit(btSoftBody& body, Water& water, const std::vector<double>& fluxes, Push push) {
    if (carryMomentum(body, water, fluxes)) {
      for (int i = 0; i < static_cast<int>(m_nodes.size()); ++i) push(body.m_nodes[i], velocityChange(body, i));
    }
    water.redistribute(m_held);
  }

  void transferState(StateArchive& archive);

 private:
  void weighEdges();
  bool carryMomentum(const btSoftBody& body, const Water& water, const std::vector<double>& fluxes);
  btVector3 velocityChange(const btSoftBody& body, int node) const;

  std::vector<WeightedEdge> m_edges;
  std::vector<double> m_weights;
  std::vector<double> m_areas;  // of nodes [m^2]
  std::vector<double> m_capacity;
  std::vector<double> m_before;  // held at load()
  std::vector<double> m_held;
  std::vector<MomentumFlow::Node> m_nodes;
  FluxLimiter m_limiter;
  MomentumFlow m_momentum;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
