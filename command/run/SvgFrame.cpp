// SPDX-License-Identifier: Zlib
#include "command/run/SvgFrame.h"

#include "command/run/Painting.h"
#include "command/run/ScenePainter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace command {
namespace {

/// The plane that is the ground of the picture: a level one that the camera is above.
const Plane* groundOf(const Scene& scene, const Camera& camera) {
  for (const Collider& collider : scene.colliders) {
    const auto* plane = collider.as<Plane>();
    if (plane == nullptr || plane->normal.dot(scene.up()) < btScalar(0.7)) continue;
    if (plane->normal.dot(camera.eye()) > btScalar(plane->offset)) return plane;
  }
  return nullptr;
}

/// A polygon without what lies behind the camera.
std::vector<btVector3> clippedToFront(const std::vector<btVector3>& polygon, const Camera& camera) {
  constexpr double nearest = 0.05;
  const auto depth = [&](const btVector3& point) {
    return static_cast<double>(camera.forward().dot(point - camera.eye())) - nearest;
  };
  std::vector<btVector3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const btVector3& a = polygon[i];
    const btVector3& b = polygon[(i + 1) % polygon.size()];
    const double depthA = depth(a);
    const double depthB = depth(b);
    if (depthA >= 0) kept.push_back(a);
    if ((depthA >= 0) != (depthB >= 0)) kept.push_back(a + (b - a) * btScalar(depthA / (depthA - depthB)));
  }
  return kept;
}

std::string pathOf(const std::vector<btVector3>& polygon, const Camera& camera) {
  std::vector<PicturePoint> points;
  for (const btVector3& corner : clippedToFront(polygon, camera)) points.push_back(camera.project(corner));
  return points.size() < 3 ? "" : pathData(points);
}

std::string svgGround(const Plane& plane, const Camera& camera) {
  constexpr double reach = 200;  // as good as the horizon
  const btVector3 foot = camera.eye() - plane.normal * (plane.normal.dot(camera.eye()) - btScalar(plane.offset));
  btVector3 u, v;
  btPlaneSpace1(plane.normal, u, v);
  std::vector<btVector3> disc;
  for (int i = 0; i < 48; ++i) {
    const double angle = SIMD_2_PI * btScalar(i) / 48;
    disc.push_back(foot + u * btScalar(reach * std::cos(angle)) + v * btScalar(reach * std::sin(angle)));
  }
  return "<path d=\"" + pathOf(disc, camera) + "\" fill=\"url(#ground)\"/>\n";
}

/// Where light that passes a point meets the ground.
btVector3 shadowOf(const btVector3& point, const Plane& ground, const btVector3& towardsLamp) {
  const btScalar height = ground.normal.dot(point) - btScalar(ground.offset);
  return point - towardsLamp * (height / ground.normal.dot(towardsLamp));
}

/// One path: overlapping parts of a shadow are not darker. All its parts run in the same sense, so they add up.
std::string shadowPath(const std::vector<btVector3>& corners, const Plane& ground, const Camera& camera) {
  const btVector3 towardsLamp = Light(camera).towardsLamp;
  std::vector<btVector3> shadow;
  for (const btVector3& corner : corners) {
    if (ground.normal.dot(corner) < btScalar(ground.offset) - btScalar(0.05)) return "";
    shadow.push_back(shadowOf(corner, ground, towardsLamp));
  }
  const btVector3 turn = (shadow[1] - shadow[0]).cross(shadow[2] - shadow[0]);
  if (turn.dot(ground.normal) < 0) return pathOf({shadow.rbegin(), shadow.rend()}, camera);
  return pathOf(shadow, camera);
}

std::string svgShadows(const SceneWorld& world, const Plane& ground, const Camera& camera, const FrameShot& shot) {
  if (ground.normal.dot(Light(camera).towardsLamp) < btScalar(0.1)) return "";
  std::string path;
  for (std::size_t i = 0; i < shot.cloths.size(); ++i) {
    const auto& positions = shot.cloths[i].positions;
    for (const auto& [a, b, c] : facesOf(*world.bodies()[i])) {
      path += shadowPath({positions[static_cast<std::size_t>(a)], positions[static_cast<std::size_t>(b)],
                          positions[static_cast<std::size_t>(c)]},
                         ground, camera);
    }
  }
  for (const Collider& collider : world.scene().colliders) {
    for (const auto& patch : piecesOf(collider, shot.time)) path += shadowPath(patch, ground, camera);
  }
  return "<path d=\"" + path + "\" fill=\"#1d2733\" fill-opacity=\".30\" filter=\"url(#soft)\"/>\n";
}

std::string escapedXml(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    if (character == '<') {
      safe += "&lt;";
    } else if (character == '&') {
      safe += "&amp;";
    } else if (static_cast<unsigned char>(character) >= ' ') {
      safe += character;
    }
  }
  return safe;
}

std::string svgCaption(const Scene& scene, const FrameShot& shot) {
  char state[96];
  std::snprintf(state, sizeof state, "t = %.2f s, saturation %.0f %%", shot.time, 100 * shot.meanSaturation);
  return "<g font-family=\"Helvetica, Arial, sans-serif\" font-size=\"19\" fill=\"#33404d\">\n"
         "<text x=\"28\" y=\"694\">" +
         escapedXml(scene.name) + "</text>\n<text x=\"932\" y=\"694\" text-anchor=\"end\">" + state + "</text>\n</g>\n";
}

/// The ground fades into the background at the horizon, which is at `horizon` pixels from the top.
std::string svgHead(double horizon) {
  char ground[160];
  std::snprintf(ground, sizeof ground,
                "<linearGradient id=\"ground\" gradientUnits=\"userSpaceOnUse\" x1=\"0\" x2=\"0\" y1=\"%.1f\" "
                "y2=\"720\">\n",
                horizon);
  return std::string(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"960\" height=\"720\" viewBox=\"0 0 960 720\">\n"
             "<defs>\n"
             "<linearGradient id=\"sky\" x1=\"0\" x2=\"0\" y1=\"0\" y2=\"1\">\n"
             "<stop offset=\"0\" stop-color=\"#d3dee8\"/><stop offset=\"1\" stop-color=\"#f4f6f7\"/>\n"
             "</linearGradient>\n") +
         ground +
         "<stop offset=\"0\" stop-color=\"#e6ebee\"/><stop offset=\".35\" stop-color=\"#d5d8d8\"/>"
         "<stop offset=\"1\" stop-color=\"#c3c2bd\"/>\n</linearGradient>\n"
         "<filter id=\"soft\" x=\"-20%\" y=\"-20%\" width=\"140%\" height=\"140%\">"
         "<feGaussianBlur stdDeviation=\"5\"/></filter>\n"
         "</defs>\n<rect width=\"960\" height=\"720\" fill=\"url(#sky)\"/>\n";
}

double horizonOf(const Scene& scene, const Camera& camera) {
  const btVector3 up = scene.up();
  const btVector3 level = camera.forward() - up * up.dot(camera.forward());
  if (level.length() < btScalar(1e-3)) return -2000;
  const double y = camera.project(camera.eye() + level * btScalar(1e4)).y;
  return std::max(-2000.0, std::min(y, 700.0));
}

}  // namespace

Camera fitCamera(const Scene& scene, const std::vector<FrameShot>& shots) {
  std::vector<btVector3> seen;
  for (const FrameShot& shot : shots) {
    for (const FrameShot::Cloth& cloth : shot.cloths) {
      seen.insert(seen.end(), cloth.positions.begin(), cloth.positions.end());
    }
    for (const Collider& collider : scene.colliders) {
      for (const auto& piece : piecesOf(collider, shot.time)) seen.insert(seen.end(), piece.begin(), piece.end());
    }
  }
  return Camera(seen, scene.camera.direction, scene.up(), scene.camera.fieldOfView);
}

std::string svgFrame(const SceneWorld& world, const Camera& camera, const FrameShot& shot) {
  const Scene& scene = world.scene();
  const Plane* const ground = groundOf(scene, camera);
  std::string svg = svgHead(horizonOf(scene, camera));
  if (ground != nullptr) svg += svgGround(*ground, camera) + svgShadows(world, *ground, camera, shot);
  Painting painting(camera);
  for (std::size_t i = 0; i < shot.cloths.size(); ++i) {
    paintCloth(painting, camera, *world.bodies()[i], shot.cloths[i]);
    paintRod(painting, camera, *world.bodies()[i], shot.cloths[i], ground);
  }
  for (const Collider& collider : scene.colliders) paintCollider(painting, camera, collider, shot.time);
  paintWater(painting, camera, scene, shot);
  return svg + painting.svg() + svgCaption(scene, shot) + "</svg>\n";
}

}  // namespace command
