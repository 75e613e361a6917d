// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/audit/SweptFaces.h"
#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "bullet_wetcloth/drops/DropPath.h"
#include "bullet_wetcloth/numerics/NodeUptake.h"

#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// A cloth that drops may land on: its faces as they moved in the last substep, and what it can still take.
class ClothTarget {
 public:
  /// Where a drop meets it.
  struct Hit {
    double time = 2;                            ///< in [0, 1] of the way; more than 1: it meets nothing
    std::array<int, 3> nodes = {-1, -1, -1};    ///< of the face
    std::array<double, 3> weights = {0, 0, 0};  ///< of the nodes, their sum 1
  };

  explicit ClothTarget(WetCloth& cloth);

  WetCloth& cloth() { return *m_cloth; }
  const WetCloth& cloth() const { return *m_cloth; }
  /// Whether its body is there to be met.
  bool isThere() const;

  /// Where the cloth is now is where it was before, too.
  void restart();
  /// A substep has ended: the cloth went from where it was to where it is now.
  void advance();

  /// The first face that a drop meets on its way, while the faces move on theirs. None is missed (Tier::conservative).
  /// Faces are as they are now where `areStill`; those with the node `except` are passed over.
  Hit firstHit(const DropPath& path, bool areStill = false, int except = -1);
  /// The place of the face that was hit, now, a little off the face on the side that a drop on this way came from, and
  /// the direction out of the face on that side.
  struct Side {
    Double3 onFace;
    Double3 place;
    Double3 normal = {0, 0, 0};  ///< of length 1; 0 of a face without area
  };
  Side sideOf(const Hit& hit, const DropPath& path) const;
  /// Of the cloth at that place [m/s].
  Double3 velocityAt(const Hit& hit) const;
  /// What of this water the nodes there have no room for [kg].
  double tooMuch(const Hit& hit, double mass) const;
  /// Water lands there with this velocity: nodes take what they have room for, with its momentum. The rest goes on with
  /// the velocity `after`, which is changed where the nodes are too light for it, or, without one, runs off the nodes.
  /// Returns what was taken [kg].
  /// Returns what was taken [kg].
  double land(const Hit& hit, double mass, const Double3& velocity, Double3* after);

  /// Drops and faces that were looked at closely, for tests that count work.
  long long candidates() const { return m_candidates; }

  void transferState(StateArchive& archive);

 private:
  void fit();
  double bounce(std::size_t node, double mass, const Double3& velocity, const Double3& after);
  void fitUptake();
  void consider(const DropPath& path, const SweptFaces::Parts<3>::Nodes& face, bool areStill, Hit& best);

  WetCloth* m_cloth;
  SweptFaces m_faces;
  NodeUptake m_uptake;
  collision::ContinuousCheck m_check;
  bool m_isFitted = false;  // the boxes
  long long m_candidates = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
