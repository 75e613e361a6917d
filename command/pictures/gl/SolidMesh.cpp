// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/SolidMesh.h"

#include "command/pictures/VectorMath.h"

#include <cmath>
#include <cstddef>

namespace pictures {
namespace {

constexpr std::size_t vertexBuffer = 0;
constexpr std::size_t instanceBuffer = 1;
constexpr float pi = 3.14159265F;

void addQuadrilateral(Solid& solid, int a, int b, int c, int d) {
  solid.triangles.push_back({a, b, c});
  solid.triangles.push_back({a, c, d});
}

/// The lid of a bar's end, round about `middle`.
void addLid(Solid& solid, const Vector3& middle, const Vector3& outwards, float radius, int sides) {
  const Vector3 u = perpendicular(outwards);
  const Vector3 v = cross(outwards, u);
  const int first = static_cast<int>(solid.vertices.size());
  for (int side = 0; side < sides; ++side) {
    const float angle = 2 * pi * static_cast<float>(side) / static_cast<float>(sides);
    solid.vertices.push_back(middle + (u * std::cos(angle) + v * std::sin(angle)) * radius);
    solid.normals.push_back(outwards);
    if (side >= 2) solid.triangles.push_back({first, first + side - 1, first + side});
  }
}

}  // namespace

SolidMesh::SolidMesh(const Solid& solid) {
  m_vertices.addBuffer(0, {3, 3});
  m_vertices.addBuffer(2, {4}, VertexArray::Step::instance);
  m_vertices.setTriangles(solid.triangles);
  update(solid);
  m_vertices.upload(instanceBuffer, {0, 0, 0, 1});
}

void SolidMesh::update(const Solid& solid) {
  std::vector<float> values;
  for (std::size_t i = 0; i < solid.vertices.size(); ++i) {
    values.insert(values.end(), solid.vertices[i].begin(), solid.vertices[i].end());
    values.insert(values.end(), solid.normals[i].begin(), solid.normals[i].end());
  }
  m_vertices.upload(vertexBuffer, values);
}

void SolidMesh::draw() const { m_vertices.drawInstances(1); }

void SolidMesh::drawAt(const std::vector<float>& instances) {
  m_vertices.upload(instanceBuffer, instances);
  m_vertices.drawInstances(instances.size() / 4);
}

Solid roundBall() {
  constexpr int rings = 8;
  constexpr int sectors = 12;
  Solid ball;
  for (int ring = 0; ring <= rings; ++ring) {
    for (int sector = 0; sector <= sectors; ++sector) {
      const float polar = pi * static_cast<float>(ring) / rings;
      const float around = 2 * pi * static_cast<float>(sector) / sectors;
      ball.vertices.push_back(
          {std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around)});
      const int here = ring * (sectors + 1) + sector;
      if (ring < rings && sector < sectors) {
        addQuadrilateral(ball, here, here + sectors + 1, here + sectors + 2, here + 1);
      }
    }
  }
  ball.normals = ball.vertices;
  return ball;
}

Solid roundBar(const Vector3& from, const Vector3& to, float radius) {
  constexpr int sides = 20;
  const Vector3 axis = unit(to - from);
  const Vector3 u = perpendicular(axis);
  const Vector3 v = cross(axis, u);
  Solid bar;
  for (int side = 0; side <= sides; ++side) {
    const float angle = 2 * pi * static_cast<float>(side) / sides;
    const Vector3 outwards = u * std::cos(angle) + v * std::sin(angle);
    for (const Vector3& end : {from, to}) {
      bar.vertices.push_back(end + outwards * radius);
      bar.normals.push_back(outwards);
    }
    if (side < sides) addQuadrilateral(bar, 2 * side, 2 * side + 2, 2 * side + 3, 2 * side + 1);
  }
  addLid(bar, from, axis * -1, radius, sides);
  addLid(bar, to, axis, radius, sides);
  return bar;
}

}  // namespace pictures
