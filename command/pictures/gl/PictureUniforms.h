// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/Extent.h"

#include "command/pictures/FrameSequence.h"
#include "command/pictures/Matrix4.h"
#include "command/pictures/View.h"

#include <array>

namespace pictures {

/// What all shaders of a picture know: the block `Picture` of common.glsl, laid out as std140 wants it.
struct PictureUniforms {
  using Vector4 = std::array<float, 4>;

  Matrix4 clipFromWorld{};
  Matrix4 shadowFromWorld{};
  Vector4 eye{};
  Vector4 towardsLamp{};
  Vector4 up{};
  Vector4 right{};
  Vector4 above{};
  Vector4 forward{};
  Vector4 shadow{};
};

/// Sets what depends on the camera.
/// @param aspect  width over height of the picture
/// @param clearance  of the eye from planes that may reach to it [m]
void look(PictureUniforms& uniforms, const View& view, float aspect, const Extent& extent, float clearance);

Vector3 eyeOf(const PictureUniforms& uniforms);

/// Where a point is seen: to the right and upwards, -1 to 1 in the picture, and its distance along the view [m].
Vector3 placeInPicture(const PictureUniforms& uniforms, const Vector3& point);

/// By how much the depth of something in the middle of the extent grows when it is moved away from the eye.
/// @param distance  moved [m]
float depthStep(const PictureUniforms& uniforms, const Extent& extent, float distance);

}  // namespace pictures
