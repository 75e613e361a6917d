// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/audit/SmallStepRecord.h"
#include "bullet_wetcloth/audit/SweptFaces.h"

#include <memory>
#include <optional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// A soft body as an audit follows it: from the end of a substep to the end of the next, and, while a ClothSolver
/// steps it, from small step to small step.
class AuditedBody {
 public:
  /// Takes the body's faces, and its present positions. Allocates.
  void build(const btSoftBody& body);
  bool fits(const btSoftBody& body) const { return m_whole.fits(body); }
  const btSoftBody* body() const { return m_whole.body(); }

  /// The body's present positions become those of all moments.
  void restart();
  /// Before a substep: sees its small steps.
  void observe();
  /// The substep has ended. Returns whether any node moved.
  bool advance() { return m_whole.advance(*body()); }
  /// Between the ends of two substeps.
  SweptFaces& whole() { return m_whole; }

  /// How many of the substep that has ended; 0 when no ClothSolver stepped the body.
  int smallSteps() const;
  /// Moves on to the end of that one. A body that has fewer stands still for the rest.
  void takeSmallStep(int index);
  /// What takeSmallStep() has not told is where the body is now. Forgets the small steps.
  void endSmallSteps();
  /// Between the ends of two small steps, for a body that has some.
  SweptFaces& small() { return m_steps->faces; }

  /// Of all moments, and the small steps that were not looked at.
  void transferState(StateArchive& archive, const btSoftBody& body);

 private:
  struct Steps {
    SweptFaces faces;
    std::shared_ptr<SmallStepRecord> record;
  };
  void follow(const btSoftBody& body);

  SweptFaces m_whole;
  std::optional<Steps> m_steps;  // of a body that a ClothSolver may take
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
