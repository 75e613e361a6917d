// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Marks that something runs for as long as it lives, and takes itself back when an application's callback throws.
class RunningMark {
 public:
  /// The mark outlives this.
  explicit RunningMark(bool& isRunning) : m_isRunning(isRunning) { m_isRunning = true; }
  ~RunningMark() { m_isRunning = false; }
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;

 private:
  bool& m_isRunning;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
