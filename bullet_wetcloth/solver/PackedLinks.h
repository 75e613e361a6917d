// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/solver/NodeSlots.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Where the nodes are that links pull at: one number for each slot.
struct LinkedNodes {
  btScalar* position[3];        ///< [m]
  const btScalar* inverseMass;  ///< [1/kg], 0 of what does not move
};

/// The links of a body in an order in which a processor works on several at once.
///
/// A link pulls its ends together as far as a spring of its stiffness k would in a step of h: with w the sum of the
/// ends' inverse masses and C the stretch, by C / (w + a) with a = 1 / (k h^2), the link's softness (XPBD; Macklin et
/// al. 2016). One pass in a step lags behind the force by half a step, which stretches a cloth beyond its springs: w /
/// 2 is taken off a, as far as it stays positive. A body that needsBothWays() has two passes in a step, there and back,
/// of which each gives half: a is twice as large then.
class PackedLinks {
 public:
  /// For the links of this body, whose nodes stand in these slots. Lengths and compliances are those of no link yet.
  void reset(const btSoftBody& body, const NodeSlots& slots);

  /// How many links.
  std::size_t size() const { return m_laneOfLink.size(); }
  /// How many of them are in stretches of consecutive slots.
  std::size_t inRuns() const { return m_inRuns; }
  /// Of a link, in the order of btSoftBody::m_links: its length at rest [m], and 1 / k [m/N], 0: it does not stretch.
  void set(std::size_t link, btScalar restLength, btScalar compliance) {
    m_restLength[m_laneOfLink[link]] = restLength;
    m_compliance[m_laneOfLink[link]] = compliance;
    m_h = 0;  // of no step: prepare() has to come
  }
  /// As last set.
  btScalar restLength(std::size_t link) const { return m_restLength[m_laneOfLink[link]]; }
  /// As last set.
  btScalar compliance(std::size_t link) const { return m_compliance[m_laneOfLink[link]]; }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// For passes in steps of h [s] with the masses that the nodes have now. A link whose length is off by no more than
  /// the rounding of a place [m] does not pull: over h it would push a cloth that nothing moves.
  void prepare(const LinkedNodes& nodes, btScalar h, btScalar rounding);
  /// How many passes a small step has: 2 is one there and one back.
  int passes() const { return m_isBothWays ? 2 : 1; }
  /// The links: first those in each tile, which work on no other tile's slots, then the others.
  void solveTile(const LinkedNodes& nodes, std::size_t tile);
  void solveOthers(const LinkedNodes& nodes);
  /// Where there are two passes: those in each tile once more, the last one first.
  void solveTileBack(const LinkedNodes& nodes, std::size_t tile);

 private:
  // Lane k: slots a + k and b + k.
  struct Run {
    std::size_t a;
    std::size_t b;
    std::size_t lanes;
    std::size_t firstLane;
  };
  // Lane k: slots a[k] and b[k], of which no two are the same; the slot after the last one where there is no link.
  struct Batch {
    int a[NodeSlots::kLanes];
    int b[NodeSlots::kLanes];
  };
  struct Corner {
    btScalar at[4];  // position, and one more for the processor's sake
  };

  std::vector<int> addRuns(const btSoftBody& body, const NodeSlots& slots);
  void addBatches(const btSoftBody& body, const NodeSlots& slots, const std::vector<int>& links);
  struct RunKernel;
  struct BatchKernel;
  struct MassKernel;
  void prepareLength(btScalar h);
  void solveRuns(const LinkedNodes& nodes, std::size_t first, std::size_t end, bool isBack);
  void gather(const LinkedNodes& nodes);
  void scatter(const LinkedNodes& nodes) const;

  bool m_isBothWays = false;
  std::vector<Run> m_runs;             // of each tile, and then between tiles
  std::vector<std::size_t> m_tileEnd;  // run after the last one of each tile
  std::vector<Batch> m_batches;
  std::vector<std::size_t> m_laneOfLink;
  PackedNodes::Lane m_restLength;      // of each lane; those of batches come after those of runs
  PackedNodes::Lane m_compliance;      // infinite where there is no link
  btScalar m_h = 0;                    // what follows is for [s]
  PackedNodes::Lane m_perRestSquared;  // [1/m^2]
  btScalar m_unfelt = 0;               // what is not felt of q^2 - 1, squared and times the length squared [m^2]
  PackedNodes::Lane m_softness;        // 1 / (k h^2) [1/kg]
  PackedNodes::Lane m_perStretch;      // of the pull, with the masses of this step [kg]
  std::size_t m_firstBatchLane = 0;
  std::size_t m_inRuns = 0;
  // For batches: the nodes, one after the other, and the inverse masses of the links' ends, by lane.
  std::vector<Corner> m_corners;
  PackedNodes::Lane m_inverseMass[2];
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
