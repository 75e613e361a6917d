// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <array>

namespace pictures {

/// Column by column, as OpenGL reads it.
using Matrix4 = std::array<float, 16>;

Matrix4 product(const Matrix4& a, const Matrix4& b);

/// World to a camera at `eye` that looks along its -z.
/// @param right, up, forward  of length 1, perpendicular to each other
Matrix4 lookFrom(const Vector3& eye, const Vector3& right, const Vector3& up, const Vector3& forward);

/// @param tangentX, tangentY  of half the angle seen
Matrix4 perspective(float tangentX, float tangentY, float nearest, float farthest);

/// The box between the two corners, of a camera that looks along its -z.
Matrix4 orthographic(const Vector3& low, const Vector3& high);

}  // namespace pictures
