// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/audit/SweptFaces.h"
#include "bullet_wetcloth/collision/ContinuousCheck.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Finds what went through what between the two moments of one or two SweptFaces.
///
/// A pair passes when it meets and is afterwards on the other side: the sign of the volume that its four points span
/// has changed. A pair that ends a substep meeting, and so near to its plane that the sign cannot be told, is
/// remembered with the side it came from; whether it goes through or returns is known when it leaves the plane.
class PassageFinder {
 public:
  /// Nodes in the order of collision::Query. Those of the first part (the vertex, or the first edge) are of
  /// `first`, the others of `second`.
  struct Subject {
    const SweptFaces* first;
    const SweptFaces* second;
    int nodes[4];
  };
  using OnPassage = std::function<void(collision::Pair, const Subject&, const collision::Contact&)>;

  PassageFinder(collision::Tier tier, OnPassage onPassage);

  /// Before all lookAt() of a substep, which together look at no more than this many pairs (and a few).
  void begin(long long mostCandidates);
  /// Looks at the vertices, faces and edges of one body.
  void lookAt(const SweptFaces& faces);
  /// Looks at those of two bodies.
  void lookAt(const SweptFaces& a, const SweptFaces& b);
  /// After all lookAt() of a substep: reports what is left, and keeps what met without a side. Returns whether all
  /// pairs were looked at.
  bool finish();
  /// Forgets which pairs were meeting.
  void forget();

  /// What was meeting. @param bodies  of the world
  void transferState(StateArchive& archive, const btAlignedObjectArray<btSoftBody*>& bodies);

  /// Pairs of which the swept boxes overlapped, since construction.
  long long candidates() const { return m_candidates; }

 private:
  static constexpr std::size_t kBlock = 256;
  static constexpr std::size_t kMostUndecided = 4096;

  // A pair that was meeting when its side could not be told, and the side it came from.
  struct Undecided {
    collision::Pair pair;
    const btSoftBody* first;
    const btSoftBody* second;
    std::array<int, 4> nodes;
    int side;
    bool operator<(const Undecided& other) const;
  };
  struct Question {
    Subject subject;
    int sideBefore;
    int sideAfter;
  };
  // Queries wait here until there are enough of them for the check to answer several at a time.
  struct Block {
    std::vector<collision::Query<btScalar>> queries;
    std::vector<Question> questions;
  };

  // Parts of one kind, of a patch, and their boxes in blocks of their own.
  struct Few {
    SweptBoxes boxes;
    std::array<int, SweptFaces::kMostInPatch> parts;
    std::size_t count = 0;
  };
  // What of a patch may meet another patch.
  struct Near {
    Few vertices, edges, faces;
  };

  void lookAt(const SweptFaces& a, int patchOfA, const SweptFaces& b, int patchOfB);
  void findNear(const SweptFaces& of, int patch, const SweptBox& box, Near& near);
  void findNear(const SweptBoxes& boxes, SweptFaces::Range range, const SweptBox& box, Few& few);
  void verticesAgainstFaces(const SweptFaces& a, const Few& vertices, const SweptFaces& b, const Few& faces);
  void edgesAgainstEdges(const SweptFaces& a, const Few& edges, const SweptFaces& b, const Few& others);
  void consider(collision::Pair pair, const Subject& subject);
  int rememberedSide(collision::Pair pair, const Subject& subject) const;
  Block& blockOf(collision::Pair pair) { return pair == collision::Pair::vertexFace ? m_vertexFace : m_edgeEdge; }
  void ask(collision::Pair pair);

  bool mayGoOn() const { return m_candidates < m_mostCandidates; }

  collision::ContinuousCheck m_check;
  OnPassage m_onPassage;
  Block m_vertexFace;
  Block m_edgeEdge;
  std::vector<collision::Contact> m_contacts;
  std::vector<Undecided> m_undecided;      // at the end of the last substep, sorted
  std::vector<Undecided> m_undecidedNext;  // at the end of this one
  Near m_near;
  Near m_nearOther;
  std::array<int, SweptFaces::kMostInPatch> m_found;  // of a search among boxes
  long long m_candidates = 0;
  long long m_mostCandidates = 0;
  bool m_isComplete = true;  // so far in this substep
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
