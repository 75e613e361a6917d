// SPDX-License-Identifier: Zlib
#include "command/run/Painting.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace command {
namespace {

double sRgb(double linear) {
  linear = std::min(1.0, std::max(0.0, linear));
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

int byteOf(double linear) { return static_cast<int>(std::lround(255 * sRgb(linear))); }

}  // namespace

Light::Light(const Camera& camera)
    : towardsLamp((camera.up() * btScalar(0.9) - camera.right() * btScalar(0.55) - camera.forward() * btScalar(0.75))
                      .normalized()) {}

wetcloth::Colour Light::shade(const wetcloth::Colour& surface, double roughness, btVector3 normal,
                              const btVector3& towardsEye) const {
  if (normal.dot(towardsEye) < 0) normal = -normal;
  const double facing = static_cast<double>(normal.dot(towardsLamp));
  const double lamp = 0.88 * std::max(0.0, (facing + 0.25) / 1.25);  // softened, as by a large lamp
  const double sky = 0.26 + 0.10 * static_cast<double>(normal.y());
  const btVector3 half = (towardsLamp + towardsEye).normalized();
  const double gloss = 1 - roughness;
  const double sharpness = 8 + 80 * gloss * gloss;
  const double shine = 0.10 * gloss * std::pow(std::max(0.0, static_cast<double>(normal.dot(half))), sharpness);
  const double light = lamp + sky;
  return {surface.r * light + shine, surface.g * light + shine, surface.b * light + shine};
}

std::string hexColour(const wetcloth::Colour& linear) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", byteOf(linear.r) & 255, byteOf(linear.g) & 255,
                byteOf(linear.b) & 255);
  return text;
}

std::string pathData(const std::vector<PicturePoint>& corners) {
  std::string data;
  for (const PicturePoint& corner : corners) {
    char text[64];
    std::snprintf(text, sizeof text, "%c%.1f %.1f", data.empty() ? 'M' : 'L', corner.x, corner.y);
    data += text;
  }
  return data + "Z";
}

void Painting::add(const std::vector<btVector3>& corners, const wetcloth::Colour& colour, double bias, double opacity) {
  Polygon polygon{bias, {}, hexColour(colour), opacity};
  for (const btVector3& corner : corners) {
    polygon.corners.push_back(m_camera.project(corner));
    if (polygon.corners.back().depth <= 0) return;  // behind the camera
    polygon.depth += polygon.corners.back().depth / static_cast<double>(corners.size());
  }
  m_polygons.push_back(std::move(polygon));
}

// A stroke of the polygon's own colour hides the seams that smoothed edges would show; where something shows through,
// it would make them darker instead.
std::string Painting::strokeOf(const Polygon& polygon) {
  if (polygon.opacity >= 1) return " stroke=\"" + polygon.colour + "\"";
  char text[64];
  std::snprintf(text, sizeof text, " fill-opacity=\"%.2f\" shape-rendering=\"crispEdges\"", polygon.opacity);
  return text;
}

std::string Painting::svg() {
  std::stable_sort(m_polygons.begin(), m_polygons.end(),
                   [](const Polygon& a, const Polygon& b) { return a.depth > b.depth; });
  std::string text = "<g stroke-width=\".8\" stroke-linejoin=\"round\">\n";
  for (const Polygon& polygon : m_polygons) {
    text +=
        "<path d=\"" + pathData(polygon.corners) + "\" fill=\"" + polygon.colour + "\"" + strokeOf(polygon) + "/>\n";
  }
  return text + "</g>\n";
}

}  // namespace command
