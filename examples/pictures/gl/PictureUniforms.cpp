#include "PictureUniforms.h"

#include "../VectorMath.h"

#include <algorithm>
#include <cmath>

namespace pictures {
namespace {

PictureUniforms::Vector4 with(const Vector3& vector, float last) { return {vector[0], vector[1], vector[2], last}; }

}  // namespace

void look(PictureUniforms& uniforms, const View& view, float aspect, const Extent& extent) {
  const Vector3 forward = unit(view.target - view.eye);
  Vector3 right = unit(cross(forward, view.up));
  if (length(right) < 0.5F) right = perpendicular(forward);
  const Vector3 above = cross(right, forward);
  const float tangent = std::tan(view.fieldOfView * 3.14159265F / 360);
  const float distance = length(extent.middle - view.eye);
  const float nearest = std::max(0.5F * (distance - extent.radius), 0.01F * extent.radius);
  const float farthest = distance + 80 * extent.radius;
  uniforms.clipFromWorld =
      product(perspective(tangent * aspect, tangent, nearest, farthest), lookFrom(view.eye, right, above, forward));
  uniforms.eye = with(view.eye, 1);
  uniforms.right = with(right, tangent * aspect);
  uniforms.above = with(above, tangent);
  uniforms.forward = with(forward, uniforms.forward[3]);
}

}  // namespace pictures
