// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/Direction.h"

#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double lengthOf(const btVector3& vector) {
  return std::hypot(static_cast<double>(vector.x()), static_cast<double>(vector.y()), static_cast<double>(vector.z()));
}

btVector3 directionOf(const btVector3& vector) {
  const double largest = static_cast<double>(vector.absolute()[vector.absolute().maxAxis()]);
  if (!(largest > 0 && std::isfinite(largest))) return btVector3(0, 0, 0);
  double scaled[3];  // so that no square overflows, nor vanishes
  for (int axis = 0; axis < 3; ++axis) scaled[axis] = static_cast<double>(vector[axis]) / largest;
  const double length = std::sqrt(scaled[0] * scaled[0] + scaled[1] * scaled[1] + scaled[2] * scaled[2]);
  if (!std::isfinite(length)) return btVector3(0, 0, 0);
  return btVector3(static_cast<btScalar>(scaled[0] / length), static_cast<btScalar>(scaled[1] / length),
                   static_cast<btScalar>(scaled[2] / length));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
