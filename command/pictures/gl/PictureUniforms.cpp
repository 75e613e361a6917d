// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/PictureUniforms.h"

#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pictures {
namespace {

PictureUniforms::Vector4 with(const Vector3& vector, float last) { return {vector[0], vector[1], vector[2], last}; }

}  // namespace

void look(PictureUniforms& uniforms, const View& view, float aspect, const Extent& extent, float clearance) {
  const Vector3 forward = unit(view.target - view.eye);
  Vector3 right = unit(cross(forward, view.up));
  if (length(right) < 0.5F) right = perpendicular(forward);
  const Vector3 above = cross(right, forward);
  const float tangent = std::tan(view.fieldOfView * 3.14159265F / 360);
  const float distance = length(extent.middle - view.eye);
  // What a ray to the picture's corner advances along the view is at most this part of its way to a plane.
  const float planes = clearance / (1 + tangent * (1 + aspect));
  const float nearest = std::max(std::min(0.5F * (distance - extent.radius), planes), 0.005F * extent.radius);
  const float farthest = distance + 80 * extent.radius;
  uniforms.clipFromWorld =
      product(perspective(tangent * aspect, tangent, nearest, farthest), lookFrom(view.eye, right, above, forward));
  uniforms.eye = with(view.eye, 1);
  uniforms.right = with(right, tangent * aspect);
  uniforms.above = with(above, tangent);
  uniforms.forward = with(forward, uniforms.forward[3]);
}

Vector3 eyeOf(const PictureUniforms& uniforms) { return {uniforms.eye[0], uniforms.eye[1], uniforms.eye[2]}; }

Vector3 placeInPicture(const PictureUniforms& uniforms, const Vector3& point) {
  const Matrix4& m = uniforms.clipFromWorld;
  const auto row = [&](std::size_t i) {
    return m[i] * point[0] + m[4 + i] * point[1] + m[8 + i] * point[2] + m[12 + i];
  };
  const float distance = row(3);
  return {row(0) / distance, row(1) / distance, distance};
}

float depthStep(const PictureUniforms& uniforms, const Extent& extent, float distance) {
  const Vector3 fromEye = extent.middle - eyeOf(uniforms);
  const auto depthAt = [&](const Vector3& place) {
    const Matrix4& m = uniforms.clipFromWorld;
    const float z = m[2] * place[0] + m[6] * place[1] + m[10] * place[2] + m[14];
    return z / placeInPicture(uniforms, place)[2];
  };
  return depthAt(extent.middle + unit(fromEye) * distance) - depthAt(extent.middle);
}

}  // namespace pictures
