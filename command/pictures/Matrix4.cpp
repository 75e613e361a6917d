// SPDX-License-Identifier: Zlib
#include "command/pictures/Matrix4.h"

#include "command/pictures/VectorMath.h"

#include <cstddef>

namespace pictures {

Matrix4 product(const Matrix4& a, const Matrix4& b) {
  Matrix4 result{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) result[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return result;
}

Matrix4 lookFrom(const Vector3& eye, const Vector3& right, const Vector3& up, const Vector3& forward) {
  return {right[0],         up[0],         -forward[0],       0,  //
          right[1],         up[1],         -forward[1],       0,  //
          right[2],         up[2],         -forward[2],       0,  //
          -dot(right, eye), -dot(up, eye), dot(forward, eye), 1};
}

Matrix4 perspective(float tangentX, float tangentY, float nearest, float farthest) {
  const float depth = farthest - nearest;
  return {1 / tangentX,
          0,
          0,
          0,  //
          0,
          1 / tangentY,
          0,
          0,  //
          0,
          0,
          -(farthest + nearest) / depth,
          -1,  //
          0,
          0,
          -2 * farthest * nearest / depth,
          0};
}

Matrix4 orthographic(const Vector3& low, const Vector3& high) {
  const Vector3 size = high - low;
  const Vector3 sum = high + low;
  return {2 / size[0],
          0,
          0,
          0,  //
          0,
          2 / size[1],
          0,
          0,  //
          0,
          0,
          -2 / size[2],
          0,  //
          -sum[0] / size[0],
          -sum[1] / size[1],
          sum[2] / size[2],
          1};
}

}  // namespace pictures
