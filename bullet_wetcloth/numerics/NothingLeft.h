// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/Water.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Tells an effect that has found nothing left to do at any node to idle until water moves, in whatever way. A member
/// of the effect. Where nothing is ever quite done, as in an exponential, SteadyState tells.
class WETCLOTH_EXPORT NothingLeft {
 public:
  /// A parameter or the body changed.
  void restart() { m_isTrue = false; }

  /// Whether the effect may leave this step out.
  bool holds(const Water& water) const { return m_isTrue && m_revision == water.revision(); }

  /// After a step that was not left out.
  void note(const Water& water, bool isNothingLeft) {
    m_isTrue = isNothingLeft;
    m_revision = water.revision();
  }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive) { archive.value(m_revision, m_isTrue); }

 private:
  bool m_isTrue = false;
  unsigned long long m_revision = 0;  // of the water when it was noted
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
