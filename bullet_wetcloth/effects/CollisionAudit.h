// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/collision/ContinuousCheck.h"

#include <LinearMath/btVector3.h>

#include <functional>
#include <memory>
#include <vector>

class btIDebugDraw;
class btSoftBody;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class AuditedBody;
class PassageFinder;

/// Something that went through something else in spite of Bullet.
struct Passage {
  double time;               ///< simulated time of the contact [s]
  btVector3 position;        ///< of the contact [m]
  collision::Pair pair;      ///< what met
  const btSoftBody* first;   ///< the body of the vertex, or of the first edge
  const btSoftBody* second;  ///< the body of the face, or of the second edge; may be the same
  /// Node numbers: vertexFace: of the vertex, then of the face; edgeEdge: of the two edges.
  int nodes[4];
  btVector3 points[4];  ///< where these nodes were at that time [m]
};

/// What an audit has counted.
struct AuditTotals {
  long long vertexFace = 0;          ///< vertices that went through faces
  long long edgeEdge = 0;            ///< edges that went through edges
  long long candidatePairs = 0;      ///< of which the swept boxes overlapped
  long long substeps = 0;            ///< looked at
  long long incompleteSubsteps = 0;  ///< of which some pairs were left out: see Parameters::mostPairsPerFace
  double seconds = 0;                ///< simulated time looked at [s]

  /// Of both kinds.
  long long passages() const { return vertexFace + edgeEdge; }
  /// Passages per second of simulated time.
  double perSecond() const { return seconds > 0 ? static_cast<double>(passages()) / seconds : 0; }
};

/// Counts what Bullet lets through: after each substep, the vertices and faces and the edges of this cloth's faces,
/// and of it and the other soft bodies of the world, that passed through each other. It changes nothing.
///
/// Nodes move in straight lines from the end of one substep to the end of the next; between bodies that ClothSolver
/// steps, and within one, from the end of one small step to the end of the next, since in a substep they may swing out
/// and back. Of two such bodies the one that has fewer small steps stands still for the rest, as the guard takes it. A
/// pair passes when it meets on the way (collision::ContinuousCheck) and ends on the other side; one that touches and
/// returns does not. A vertex of a face is no pair with it, nor are two edges with a common vertex. Edges are those of
/// faces, each once; links do not count. A face with a node that is not finite is left out while it is so.
///
/// A substep is looked at in the next one, before Bullet predicts; look() does it at once. The first substep after
/// the effect was added, after reset(), and the one in which a body was cut, or was out of the world, is not looked at.
///
/// Two cloths that both have an audit: the pairs between them are counted by the one that was added first.
class WETCLOTH_EXPORT CollisionAudit : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    bool self = true;    ///< pairs within this cloth
    bool others = true;  ///< pairs of this cloth and any other soft body of the world that has faces
    /// None misses a passage. Tier::exact has no false alarms either, where something just clears an edge.
    collision::Tier tier = collision::Tier::fast;
    /// When the swept boxes of more pairs than this for each face of the cloth overlap in a substep, or in a small step
    /// where these are looked at, the rest of it is left out. A cloth that swings has about 12, one shaken by several
    /// edges' length a substep about 80, an exploded one all there are, which takes the square of its size. The first
    /// time, the world's log says so.
    int mostPairsPerFace = 500;
    /// Called for each passage, in the step, in no order of time within a substep; or null. It must not change bodies.
    std::function<void(const Passage&)> onPassage = nullptr;
  };

  /// passages() keeps no more of a substep than this; all are counted.
  static constexpr int kMostKept = 1024;

  /// Throws std::invalid_argument when this build lacks the tier, or mostPairsPerFace is not positive.
  explicit CollisionAudit(Parameters parameters);
  ~CollisionAudit() override;
  CollisionAudit(const CollisionAudit&) = delete;
  CollisionAudit& operator=(const CollisionAudit&) = delete;

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. The substep that
  /// has begun is looked at by the new ones; another tier forgets which pairs are just meeting. Not from inside
  /// onPassage.
  void setParameters(Parameters parameters);
  /// Since the effect was made.
  AuditTotals totals() const;
  /// Those of the substep looked at last.
  const std::vector<Passage>& passages() const { return m_passages; }

  /// Looks at what has happened since the last look: after the last step of a run, and before the bodies are cut or
  /// moved by hand. Nothing is counted twice, and nothing of a body that has left the world.
  void look();
  /// Call it after nodes were moved by hand, which would look like motion. Totals stay.
  void reset();
  /// Draws passages(): a cross, and the vertex and face or the edges as they met.
  void draw(btIDebugDraw& drawer) const;

  const char* name() const override { return "CollisionAudit"; }
  /// It runs while Bullet lets the body sleep, too: sleeping nodes may move.
  Stage stage() const override { return Stage::observe; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

 private:
  struct Other;

  std::unique_ptr<PassageFinder> makeFinder(collision::Tier tier);
  bool isBodyThere() const;
  void restart();
  void observe();
  void lookUntil(double time);
  bool lookAtWhole();
  bool lookAtSmallSteps(double time);
  bool lookAtSmallStep();
  int smallSteps() const;
  long long mostCandidates() const;
  void sayIncomplete();
  bool followOthers();
  bool follow(const btSoftBody& body);
  bool isOurs(const btSoftBody& other) const;
  void transferOthers(StateArchive& archive);

  Parameters m_parameters;
  AuditTotals m_totals;
  std::vector<Passage> m_passages;
  WetCloth* m_cloth = nullptr;
  std::unique_ptr<AuditedBody> m_own;
  std::vector<Other> m_others;  // of which the pairs with this cloth are ours to count
  std::unique_ptr<PassageFinder> m_finder;
  std::unique_ptr<PassageFinder> m_smallFinder;  // of what passes in small steps
  bool m_isFollowing = false;                    // the last positions and their time are known
  bool m_isPending = false;                      // a substep has begun since the last look
  double m_time = 0;                             // of the last positions [s]
  double m_dt = 0;                               // of the pending substep [s]
  double m_lookBegin = 0;                        // of the time that is looked at [s]
  double m_lookEnd = 0;                          // [s]
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
