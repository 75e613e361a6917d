// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

namespace pictures {

/// An upright box.
struct Bounds {
  Vector3 low{1e30F, 1e30F, 1e30F};  ///< [m]
  Vector3 high{-1e30F, -1e30F, -1e30F};

  void add(const Vector3& point);
  Vector3 middle() const;
  float diagonal() const;  ///< [m]
};

/// Around all cloths in all frames, and the solids.
Bounds boundsOf(const FrameSequence& sequence);

}  // namespace pictures
