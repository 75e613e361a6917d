// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardCling.h"
#include "bullet_wetcloth/solver/GuardGroups.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Pairs of parts that may meet, each with a plane between them, and what keeps the parts on their sides of it.
class GuardPairs {
 public:
  /// How parts act on each other.
  struct Contact {
    btScalar thickness;    ///< nearer than that they do not approach, and slowly part [m]
    btScalar touching;     ///< nearer than that wet ones hold each other [m]
    btScalar friction;     ///< coefficient
    btScalar rounding;     ///< of a place [m]
    btScalar mostParting;  ///< how far they part in a small step at most [m]
  };
  /// What a small step came to.
  struct Outcome {
    long long stopped = 0;  ///< nodes that went with the mean of those around them, wholly or in part
    long long forced = 0;   ///< pairs that imposed nodes leave no room
  };

  /// Puts planes between the parts of these pairs, too, where they were at the end of the small step before. Drops
  /// those that cannot meet, nor come within the thickness, while every node keeps to where it is expected. Returns how
  /// many meet already: between them is no plane, and they may pass.
  long long look(const GuardNodes& nodes, const GuardCandidates& pairs, const Contact& contact);
  void clear();
  /// Takes out the planes of pairs for which isGone(pair) is true.
  template <class IsGone>
  void drop(const IsGone& isGone) {
    for (GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
      planes->filter([&](std::size_t plane) { return !isGone(planes->pair(plane)); });
    }
  }
  bool isEmpty() const { return size() == 0; }
  /// What holds wet layers together.
  GuardCling& cling() { return m_cling; }
  /// Coefficient between the two places of a plane.
  btScalar frictionOf(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const;
  const GuardPlanes& vertexFace() const { return m_vertexFace; }
  /// Calls action(node) for the nodes of all pairs, some more than once.
  template <class Action>
  void forEachNode(const Action& action) const {
    for (const GuardPlanes* const planes : {&m_vertexFace, &m_edgeEdge}) {
      for (std::size_t plane = 0; plane < planes->size(); ++plane) {
        for (int k = 0; k < 4; ++k) action(planes->node(plane, k));
      }
    }
  }
  std::size_t size() const { return m_vertexFace.size() + m_edgeEdge.size(); }

  /// Parts that are within the thickness move away from each other, without a change of velocity. Once a small step.
  void part(GuardNodes& nodes);
  /// Moves the nodes' places at the end of a small step so that no part leaves its side.
  Outcome enforce(GuardNodes& nodes);
  /// The nodes that the last enforce() has slowed.
  const std::vector<int>& slowed() const { return m_groups.members(); }
  /// Whether all parts are on their sides, where enforce() left the nodes, or where they are after a look. If they are,
  /// the small step is over for the planes.
  bool settle(const GuardNodes& nodes);
  /// Gives up planes that imposed nodes leave no room, and returns how many.
  long long release(const GuardNodes& nodes);

 private:
  struct Violation {
    GuardPlanes* planes;
    std::size_t plane;
    btScalar gap;  // [m]
  };

  btScalar reach() const;
  btScalar wantedGapOf(btScalar gapBefore) const;
  bool isViolated(const GuardPlanes& planes, std::size_t plane, btScalar gap) const;
  template <class Action>
  void forEachNear(std::size_t block, const GuardPlanes::Measure& measure, btScalar apart, const Action& action) const;
  template <class Action>
  void forEachNear(std::size_t block, const GuardPlanes::Measure& measure, const Action& action) const;
  bool holds(GuardPlanes& planes, const GuardNodes& nodes);
  bool isApart(const GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const;
  void part(const GuardPlanes& planes, GuardNodes& nodes) const;
  void part(const GuardPlanes& planes, std::size_t plane, btScalar missing, GuardNodes& nodes) const;
  bool pass(GuardPlanes& planes, GuardNodes& nodes) const;
  btScalar keepApart(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const;
  void keepSides(const GuardPlanes& planes, std::size_t plane, GuardNodes& nodes) const;
  bool slow(GuardNodes& nodes, int round);
  bool turn(GuardPlanes& planes, std::size_t plane, const GuardNodes& nodes) const;

  GuardPlanes m_vertexFace{1};
  GuardPlanes m_edgeEdge{2};
  bool m_isMeasured = false;  // all planes, where nodes are
  std::vector<Violation> m_violated;
  Contact m_contact = {};
  GuardCling m_cling;
  GuardGroups m_groups;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
