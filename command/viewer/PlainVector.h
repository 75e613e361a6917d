// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <LinearMath/btVector3.h>

namespace viewer {

/// A vector of a picture as Bullet's, and back.
inline btVector3 bulletVector(const pictures::Vector3& vector) {
  return btVector3(btScalar(vector[0]), btScalar(vector[1]), btScalar(vector[2]));
}
inline pictures::Vector3 plainVector(const btVector3& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

}  // namespace viewer
