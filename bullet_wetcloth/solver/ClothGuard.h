// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/solver/ClothSolver.h"
#include "bullet_wetcloth/solver/CoincidentExemptions.h"
#include "bullet_wetcloth/solver/ExpectedWay.h"
#include "bullet_wetcloth/solver/GuardExemptions.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardPairs.h"
#include "bullet_wetcloth/solver/GuardStops.h"
#include "bullet_wetcloth/solver/GuardTiles.h"
#include "bullet_wetcloth/solver/SmallStep.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class CrossingExemptions;

/// Keeps cloths from passing through themselves and through each other, small step by small step: see docs/guard.md.
///
/// It knows that nothing has met at the end of the small step before, and where the nodes want to go. For some small
/// steps ahead it expects each node on its way, within a distance of it; what cannot meet as long as that holds is not
/// looked at again. What is left are pairs, each with a plane between its two parts. After a small step both parts of
/// each pair are on their sides of its plane, and every node is where it was expected; so nothing has met.
class ClothGuard {
 public:
  /// A cloth in this step.
  struct Cloth {
    const GuardMesh* mesh;  ///< which lives as long as the cloth is guarded
    MovingNodes nodes;
    const int* slots;  ///< of its nodes
    int nodeCount;
    btVector3 origin;      ///< of its places, whole numbers [m]
    btScalar h;            ///< of its small steps [s]
    bool isStill = false;  ///< it is not stepped: nothing moves it
    bool isNew = false;    ///< its mesh is a new one
    const LayerWetness* wetness = nullptr;
    const int* nodeOfSlot = nullptr;        ///< of each slot, -1: none; or null: it is not known
    CoincidentNodes* coincident = nullptr;  ///< which count as one; or null: there are none
    /// By slot: with which the step before ended, without what has pushed the cloth since then [m/s]; or null:
    /// velocity.
    const btScalar* settled[3] = {nullptr, nullptr, nullptr};
  };

  /// Before the first small step of a step: nodes stand where they were at its end, and pins where they come from.
  /// @param smallSteps  how often hold() is called in this step
  /// @param exemptions  of pairs, which outlive the step; or null
  /// @param crossings   that are left alone, in the same way
  void begin(const std::vector<Cloth>& cloths, const ClothSolver::Guard& parameters, int smallSteps,
             const GuardExemptions* exemptions = nullptr, const CrossingExemptions* crossings = nullptr);
  /// After each small step.
  void hold();
  /// What the nodes of bodies have pushed since then: see GuardNodes.
  const std::vector<GuardNodes::Place>& recoil() const { return m_nodes.recoil; }

  /// After hold(): the planes between vertices and faces, and the nodes that they name, at `to`.
  const GuardPlanes& vertexFace() const { return m_pairs.vertexFace(); }
  const GuardNodes& nodes() const { return m_nodes; }
  /// Of each cloth the first of its nodes among all.
  const std::vector<std::size_t>& firstNodes() const { return m_first; }
  /// Places that are nearer touch [m]: layers that lie on each other are the thickness apart, and a little more or
  /// less.
  btScalar touching() const { return m_contact.touching; }
  btScalar frictionOf(std::size_t vertexFacePlane) const {
    return m_pairs.frictionOf(m_pairs.vertexFace(), vertexFacePlane, m_nodes);
  }

  const ClothSolver::GuardTotals& totals() const { return m_totals; }
  void resetTotals() {
    m_totals = {};
    m_stops.reset();
  }
  const GuardStops& stops() const { return m_stops; }

 private:
  void beginStops(const std::vector<Cloth>& cloths);
  void keep();
  bool isWhereExpected() const;
  void look();
  double expectAll();
  void lookAgain();
  void expectOnPresentWay(std::size_t cloth, int node);
  void showExpected(std::size_t cloth);
  void showExpected(std::size_t cloth, int node);
  WaySlack slackFor(int steps) const;
  WaySlack slackOfCloth(std::size_t cloth) const;
  void addPlanes();
  void enforce();
  void takeWetness();
  void forgetAside();
  void keepAside();
  template <class Action>
  void forEachNode(const Action& action) const;
  template <class Action>
  void forEachHeld(const Action& action) const;
  template <class Action>
  void forEachAside(const Action& action);
  std::size_t clothOf(int node) const;
  void findHeld();
  void gatherToMove();
  void gather();
  void gatherAll();
  void gatherAll(std::size_t cloth);
  void gather(const GuardCandidates& pairs);
  void gather(std::size_t cloth, int node);
  void scatter();
  void stopAll();

  std::vector<Cloth> m_cloths;
  std::vector<std::size_t> m_first;  // of each cloth's nodes among all
  ClothSolver::Guard m_parameters;
  const GuardExemptions* m_exemptions = nullptr;
  const CrossingExemptions* m_crossings = nullptr;
  CoincidentExemptions m_coincident;
  ClothSolver::GuardTotals m_totals;
  GuardStops m_stops;
  GuardTiles m_tiles;
  GuardPairs m_pairs;
  GuardPairs::Contact m_contact = {};
  GuardNodes m_nodes;
  GuardCandidates m_candidates;
  // Of each cloth, by slot: where nodes were at the end of the last small step and of the one before, and where they
  // were at the last look, how far in a small step it expects them to go, and how far from there they may be.
  struct Kept {
    PackedNodes::Lane before[3];
    PackedNodes::Lane last[3];
    PackedNodes::Lane from[3];
    PackedNodes::Lane way[3];
    PackedNodes::Lane slack;
  };
  std::vector<Kept> m_kept;
  std::vector<int> m_left;      // nodes that were not where they were expected
  PackedNodes::Lane m_isFound;  // of each node of a cloth, by slot
  std::vector<int> m_held;      // nodes that pairs hold, ascending, unless
  bool m_areAllHeld = false;    // that are most of them
  std::vector<int> m_aside;     // nodes that may be aside, some more than once, unless
  bool m_areAllAside = false;   // all may be
  int m_smallSteps = 0;         // in this step
  int m_taken = 0;              // of them
  int m_age = 0;                // small steps since the last look at all nodes, that one included
  int m_ahead = 0;              // for how many it was
  btScalar m_slackFactor = 1;
  bool m_isAnyGrid = false;
  btScalar m_edge = 0;        // the mean edge [m]
  btScalar m_rounding = 0;    // of a place [m]
  btScalar m_leastSlack = 0;  // of a node [m]
  btScalar m_mostSlack = 0;   // of a node, but for those that leave their way again and again [m]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
