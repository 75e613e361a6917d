// SPDX-License-Identifier: Zlib
#include "command/run/ScenePainter.h"

#include "command/scene/ColliderSurface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace command {
namespace {

const wetcloth::Colour colliderColour{0.50, 0.42, 0.33};
const wetcloth::Colour rodColour{0.16, 0.17, 0.19};
const wetcloth::Colour waterColour{0.08, 0.22, 0.32};
constexpr double colliderRoughness = 0.8;
/// Cloth lies on colliders, its margin above them: they are painted as if they were this much farther away [m].
constexpr double colliderBias = 0.06;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

std::vector<btVector3> vertexNormals(const std::vector<std::array<int, 3>>& faces,
                                     const std::vector<btVector3>& positions) {
  std::vector<btVector3> normals(positions.size(), btVector3(0, 0, 0));
  for (const auto& [a, b, c] : faces) {
    const btVector3 normal = (positions[at(b)] - positions[at(a)]).cross(positions[at(c)] - positions[at(a)]);
    for (const int corner : {a, b, c}) normals[at(corner)] += normal;
  }
  return normals;
}

btVector3 unit(const btVector3& vector) {
  const btScalar length = vector.length();
  return length > btScalar(1e-12) ? btVector3(vector / length) : btVector3(0, 0, 0);
}

/// Each normal averaged with those of its neighbours: flat triangles show every wrinkle of the mesh otherwise.
std::vector<btVector3> smoothed(const std::vector<std::array<int, 3>>& faces, const std::vector<btVector3>& normals) {
  std::vector<btVector3> sums(normals.size(), btVector3(0, 0, 0));
  for (const auto& [a, b, c] : faces) {
    const btVector3 sum = unit(normals[at(a)]) + unit(normals[at(b)]) + unit(normals[at(c)]);
    for (const int corner : {a, b, c}) sums[at(corner)] += sum;
  }
  return sums;
}

/// The corners of both triangles in turn when they share an edge, else nothing.
std::vector<int> quadrilateral(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  const auto isIn = [](const std::array<int, 3>& face, int node) {
    return std::find(face.begin(), face.end(), node) != face.end();
  };
  const auto apex = std::find_if(b.begin(), b.end(), [&](int node) { return !isIn(a, node); });
  for (std::size_t k = 0; apex != b.end() && k < 3; ++k) {
    const int from = a[k];
    const int to = a[(k + 1) % 3];
    if (isIn(b, from) && isIn(b, to)) return {from, *apex, to, a[(k + 2) % 3]};
  }
  return {};
}

/// Triangles that follow each other and share an edge are painted as one piece: it halves the picture, and the two
/// triangles of a square would show as a checked pattern where the cloth bends.
std::vector<std::vector<int>> piecesOf(const std::vector<std::array<int, 3>>& faces) {
  std::vector<std::vector<int>> pieces;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool isLast = i + 1 == faces.size();
    const std::vector<int> both = isLast ? std::vector<int>() : quadrilateral(faces[i], faces[i + 1]);
    if (both.empty()) {
      pieces.emplace_back(faces[i].begin(), faces[i].end());
    } else {
      pieces.push_back(both);
      ++i;
    }
  }
  return pieces;
}

/// A flat piece of a collider, if it faces the camera.
void addFacing(Painting& painting, const Camera& camera, const std::vector<btVector3>& corners) {
  const btVector3 middle = (corners[0] + corners[2]) / 2;
  const btVector3 normal = unit((corners[2] - corners[0]).cross(corners[corners.size() == 3 ? 2 : 3] - corners[1]));
  const btVector3 towardsEye = camera.towards(middle);
  if (normal.dot(towardsEye) <= btScalar(-0.05)) return;
  const Light light(camera);
  painting.add(corners, light.shade(colliderColour, colliderRoughness, normal, towardsEye), colliderBias);
}

std::vector<btVector3> pinnedPositions(const btSoftBody& body, const FrameShot::Cloth& cloth) {
  std::vector<btVector3> pinned;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im == 0) pinned.push_back(cloth.positions[at(i)]);
  }
  return pinned;
}

/// The two ends of points that lie on one line; false when they do not, or are fewer than two.
bool endsOfLine(const std::vector<btVector3>& points, btVector3& first, btVector3& last) {
  if (points.size() < 2) return false;
  const auto farthestFrom = [&](const btVector3& from) {
    return *std::max_element(points.begin(), points.end(), [&](const btVector3& a, const btVector3& b) {
      return (a - from).length2() < (b - from).length2();
    });
  };
  first = farthestFrom(points.front());
  last = farthestFrom(first);
  const btScalar length = (last - first).length();
  if (!(length > 0)) return false;
  const btVector3 axis = (last - first) / length;
  return std::all_of(points.begin(), points.end(), [&](const btVector3& point) {
    return (point - first).cross(axis).length() < btScalar(0.01) * length;
  });
}

/// A thin round bar as strips that face the camera, each lit as its part of the round.
void paintBar(Painting& painting, const Camera& camera, const btVector3& from, const btVector3& to, double radius) {
  constexpr int pieces = 24;
  constexpr int strips = 5;
  const Light light(camera);
  const btVector3 along = (to - from) / btScalar(pieces);
  for (int piece = 0; piece < pieces; ++piece) {
    const btVector3 a = from + along * btScalar(piece);
    const btVector3 towardsEye = camera.towards(a);
    const btVector3 side = unit(along.cross(towardsEye));
    for (int strip = 0; strip < strips; ++strip) {
      const btScalar low = btScalar(2.0 * strip / strips - 1);
      const btScalar high = btScalar(2.0 * (strip + 1) / strips - 1);
      const btScalar middle = (low + high) / 2;
      const btVector3 normal = side * middle + towardsEye * btScalar(std::sqrt(1 - middle * middle));
      const btVector3 inner = side * (low * btScalar(radius));
      const btVector3 outer = side * (high * btScalar(radius));
      painting.add({a + inner, a + outer, a + along + outer, a + along + inner},
                   light.shade(rodColour, 0.45, normal, towardsEye), 3 * radius);
    }
  }
}

}  // namespace

std::vector<std::array<int, 3>> facesOf(const btSoftBody& body) {
  std::vector<std::array<int, 3>> faces;
  const btSoftBody::Node* const first = &body.m_nodes[0];
  for (int i = 0; i < body.m_faces.size(); ++i) {
    const auto& nodes = body.m_faces[i].m_n;
    faces.push_back(
        {static_cast<int>(nodes[0] - first), static_cast<int>(nodes[1] - first), static_cast<int>(nodes[2] - first)});
  }
  return faces;
}

void paintCloth(Painting& painting, const Camera& camera, const btSoftBody& body, const FrameShot::Cloth& cloth) {
  const Light light(camera);
  const auto faces = facesOf(body);
  const std::vector<btVector3> normals = smoothed(faces, vertexNormals(faces, cloth.positions));
  for (const std::vector<int>& piece : piecesOf(faces)) {
    const double share = 1 / static_cast<double>(piece.size());
    std::vector<btVector3> corners;
    btVector3 normal(0, 0, 0);
    wetcloth::Colour colour;
    double roughness = 0;
    for (const int corner : piece) {
      corners.push_back(cloth.positions[at(corner)]);
      normal += unit(normals[at(corner)]);
      colour.r += cloth.colours[at(corner)].r * share;
      colour.g += cloth.colours[at(corner)].g * share;
      colour.b += cloth.colours[at(corner)].b * share;
      roughness += cloth.roughnesses[at(corner)] * share;
    }
    painting.add(corners, light.shade(colour, roughness, unit(normal), camera.towards(corners[0])));
  }
}

void paintRod(Painting& painting, const Camera& camera, const btSoftBody& body, const FrameShot::Cloth& cloth,
              const Plane* ground) {
  btVector3 first, last;
  if (!endsOfLine(pinnedPositions(body, cloth), first, last)) return;
  const btVector3 axis = (last - first).normalized();
  const btScalar length = (last - first).length();
  btVector3 low = first - axis * (btScalar(0.05) * length);
  btVector3 high = last + axis * (btScalar(0.05) * length);
  if (ground != nullptr && std::abs(ground->normal.dot(axis)) > btScalar(0.99)) {
    btVector3& foot = ground->normal.dot(low) < ground->normal.dot(high) ? low : high;
    foot -= ground->normal * (ground->normal.dot(foot) - btScalar(ground->offset));
  }
  paintBar(painting, camera, low, high, 0.012 * static_cast<double>(length));
}

std::vector<std::vector<btVector3>> piecesOf(const Collider& collider, double time) {
  const btTransform place = collider.at(time);
  std::vector<std::vector<btVector3>> pieces;
  for (ColliderSurface::Piece& piece : surfaceOf(collider).pieces) {
    for (btVector3& corner : piece.corners) corner = place * corner;
    pieces.push_back(std::move(piece.corners));
  }
  return pieces;
}

void paintCollider(Painting& painting, const Camera& camera, const Collider& collider, double time) {
  for (const auto& piece : piecesOf(collider, time)) addFacing(painting, camera, piece);
}

void paintWater(Painting& painting, const Camera& camera, const Scene& scene, const FrameShot& shot) {
  if (!scene.water) return;
  const btVector3 up = scene.up();
  btVector3 u, v;
  btPlaneSpace1(up, u, v);
  btVector3 low(btScalar(1e9), btScalar(1e9), 0);
  btVector3 high = -low;
  for (const FrameShot::Cloth& cloth : shot.cloths) {
    for (const btVector3& position : cloth.positions) {
      const btVector3 onSurface(u.dot(position), v.dot(position), 0);
      low.setMin(onSurface);
      high.setMax(onSurface);
    }
  }
  constexpr int count = 24;  // small ones, so that cloth before and behind them sorts rightly
  const btScalar rim = btScalar(0.15) + (high - low).length() / 4;
  const btVector3 start = low - btVector3(rim, rim, 0);
  const btVector3 piece = (high - low + btVector3(2 * rim, 2 * rim, 0)) / count;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const btVector3 corner = up * btScalar(scene.water->level) + u * (start.x() + piece.x() * btScalar(i)) +
                               v * (start.y() + piece.y() * btScalar(j));
      const btVector3 alongU = u * piece.x();
      const btVector3 alongV = v * piece.y();
      painting.add({corner, corner + alongU, corner + alongU + alongV, corner + alongV},
                   Light(camera).shade(waterColour, 0.3, up, camera.towards(corner)), 0, 0.45);
    }
  }
}

}  // namespace command
