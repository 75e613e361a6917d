// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/solver/GuardScene.h"
#include "tests/support/Pi.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// A place in double.
struct TangledPoint {
  double x, y, z;
};
inline TangledPoint operator-(const TangledPoint& a, const TangledPoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double dot(const TangledPoint& a, const TangledPoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline TangledPoint cross(const TangledPoint& a, const TangledPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How many edges go through faces that share no node with them, of these bodies' faces: each edge is tried against
/// each face (Moeller and Trumbore 1997), without any of the library's own search.
inline int countCrossings(const std::vector<const btSoftBody*>& bodies) {
  std::vector<TangledPoint> places;
  std::vector<std::array<int, 3>> faces;
  std::set<std::pair<int, int>> edges;
  for (const btSoftBody* body : bodies) {
    const int first = int(places.size());
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      const btVector3& x = body->m_nodes[k].m_x;
      places.push_back({double(x.x()), double(x.y()), double(x.z())});
    }
    for (int k = 0; k < body->m_faces.size(); ++k) {
      std::array<int, 3> face;
      for (int i = 0; i < 3; ++i) face[std::size_t(i)] = first + numberOf(*body, body->m_faces[k].m_n[i]);
      faces.push_back(face);
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(face[i], face[(i + 1) % 3]));
    }
  }
  int count = 0;
  for (const auto& edge : edges) {
    const TangledPoint& p = places[std::size_t(edge.first)];
    const TangledPoint way = places[std::size_t(edge.second)] - p;
    for (const auto& face : faces) {
      if (std::count(face.begin(), face.end(), edge.first) + std::count(face.begin(), face.end(), edge.second) > 0) {
        continue;
      }
      const TangledPoint& a = places[std::size_t(face[0])];
      const TangledPoint u = places[std::size_t(face[1])] - a;
      const TangledPoint v = places[std::size_t(face[2])] - a;
      const TangledPoint h = cross(way, v);
      const double scale = dot(u, h);
      if (scale == 0) continue;
      const TangledPoint from = p - a;
      const double alongU = dot(from, h) / scale;
      const TangledPoint q = cross(from, u);
      const double alongV = dot(way, q) / scale;
      const double along = dot(v, q) / scale;
      count += alongU > 0 && alongV > 0 && alongU + alongV < 1 && along > 0 && along < 1 ? 1 : 0;
    }
  }
  return count;
}

/// A guard that untangles.
inline Guard untangling() {
  Guard guard;
  guard.untangle = true;
  return guard;
}

/// A sheet whose edges are pinned at y = 0, and a smaller one that hangs in the air with a corner through it: its
/// lowest corner is this far below.
inline std::pair<btSoftBody*, btSoftBody*> addCornerThroughSheet(GuardScene& scene, double depth,
                                                                 bool isPinned = true) {
  wetcloth::ClothPatch patch = levelSheet(13, 0.6, btVector3(0, 0, 0));
  using Edge = wetcloth::ClothPatch::Edge;
  if (isPinned) patch.pinnedEdges = {Edge::left, Edge::right, Edge::bottom, Edge::top};
  btSoftBody* const sheet = &scene.add(patch);
  patch = squarePatch(9);
  const double slope = 0.5;
  patch.origin = btVector3(btScalar(0.013), btScalar(-depth), btScalar(0.008));
  patch.edgeU = btVector3(btScalar(0.25 * std::cos(slope)), btScalar(0.25 * std::sin(slope)), 0);
  patch.edgeV = btVector3(0, btScalar(0.25 * std::sin(slope)), btScalar(0.25 * std::cos(slope)));
  return {sheet, &scene.add(patch)};
}

/// A sheet a corner of which is rolled over so far that its tip goes through the sheet.
inline Triangles rolledSheet(int n, double side) {
  Triangles mesh = Triangles::of(levelSheet(n, side, btVector3(0, 0, 0)));
  const double radius = 0.03;
  const double end = 4 * kPi / 3;  // where it goes on straight
  for (btVector3& place : mesh.places) {
    const double along = double(place.x() - place.z()) / std::sqrt(2.0);
    const double across = double(place.x() + place.z()) / std::sqrt(2.0) - side * std::sqrt(0.5) + 0.26;
    if (across <= 0) continue;
    const double turn = std::min(across / radius, end);
    const double straight = across - turn * radius;
    const double out = radius * std::sin(turn) + straight * std::cos(turn) - across;
    const double up = radius * (1 - std::cos(turn)) + straight * std::sin(turn);
    const double at = double(place.x() + place.z()) / std::sqrt(2.0) + out;
    place.setValue(btScalar((at + along) / std::sqrt(2.0)), btScalar(up), btScalar((at - along) / std::sqrt(2.0)));
  }
  return mesh;
}

}  // namespace wetcloth_test
