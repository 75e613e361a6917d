// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Require.h"

#include <BulletSoftBody/btSoftBody.h>

#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// For an effect that works on triangles: throws std::invalid_argument naming the effect when the body has none.
inline void requireFaces(const char* effect, const btSoftBody& body) {
  if (body.m_faces.size() > 0) return;
  rejectValue(std::string(effect) + ": body.m_faces.size()", 0,
              "at least 1: it works on triangles, and a rope has none");
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
