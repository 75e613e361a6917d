// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/TriangleArea.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Of a cotangent. Rest lengths are single precision, so the right angles of a grid are known to 1e-7; whichever
// diagonal a square has, it must neither be flipped nor conduct.
constexpr double kCotangentRounding = 1e-6;
constexpr double kDegenerate = 1e-9;  // area over the longest side's square
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr std::size_t kFlipsPerEdge = 100;  // more is rounding that goes round in circles

class Triangulation {
 public:
  explicit Triangulation(const std::vector<MeasuredTriangle>& triangles);
  void makeDelaunay();
  std::vector<WeightedEdge> weights() const;

 private:
  struct Face {
    std::array<int, 3> nodes;
    std::array<int, 3> edges;  // edges[k] is opposite nodes[k]
  };
  struct Edge {
    int a;
    int b;
    double length;
    int faceCount;
    std::array<int, 2> faces;
  };
  struct Side {
    int a;
    int b;
    int face;
    std::size_t corner;
    double length;
  };

  void addEdges(std::vector<Side>& sides);
  double doubleArea(const Face& face) const;
  double cotangent(int face, int edge, double ofNoArea) const;
  bool canFlip(int edge) const;
  bool flip(int edge);
  std::size_t cornerOpposite(int face, int edge) const;
  void replaceFace(int edge, int from, int to);

  std::vector<Face> m_faces;
  std::vector<Edge> m_edges;
};

bool isUsable(const MeasuredTriangle& triangle) {
  const auto& n = triangle.nodes;
  const double sum = triangle.lengths[0] + triangle.lengths[1] + triangle.lengths[2];
  return n[0] != n[1] && n[1] != n[2] && n[2] != n[0] && std::isfinite(sum);
}

Triangulation::Triangulation(const std::vector<MeasuredTriangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const MeasuredTriangle& triangle : triangles) {
    if (!isUsable(triangle)) continue;
    const int face = static_cast<int>(m_faces.size());
    m_faces.push_back({triangle.nodes, {-1, -1, -1}});
    for (std::size_t k = 0; k < 3; ++k) {
      const auto ends = std::minmax(triangle.nodes[(k + 1) % 3], triangle.nodes[(k + 2) % 3]);
      sides.push_back({ends.first, ends.second, face, k, triangle.lengths[k]});
    }
  }
  addEdges(sides);
}

void Triangulation::addEdges(std::vector<Side>& sides) {
  const auto ends = [](const Side& side) { return std::make_pair(side.a, side.b); };
  std::sort(sides.begin(), sides.end(), [&](const Side& one, const Side& other) {
    return std::make_pair(ends(one), one.face) < std::make_pair(ends(other), other.face);
  });
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    Edge edge = {sides[first].a, sides[first].b, 0, 0, {-1, -1}};
    for (last = first; last < sides.size() && ends(sides[last]) == ends(sides[first]); ++last) {
      const Side& side = sides[last];
      m_faces[toSize(side.face)].edges[side.corner] = static_cast<int>(m_edges.size());
      if (edge.faceCount < 2) edge.faces[toSize(edge.faceCount)] = side.face;
      ++edge.faceCount;
      edge.length += side.length;
    }
    edge.length /= edge.faceCount;  // in a metric that turns from triangle to triangle they differ
    m_edges.push_back(edge);
  }
}

// 0 when the triangle is degenerate.
double Triangulation::doubleArea(const Face& face) const {
  const double a = m_edges[toSize(face.edges[0])].length;
  const double b = m_edges[toSize(face.edges[1])].length;
  const double c = m_edges[toSize(face.edges[2])].length;
  const double area = triangleArea(a, b, c);
  const double longest = std::max({a, b, c});
  return area > kDegenerate * longest * longest ? 2 * area : 0;
}

// Of the angle opposite the edge. In a triangle of no area it is infinite or, for `ofNoArea` 0, of no account.
double Triangulation::cotangent(int face, int edge, double ofNoArea) const {
  const Face& f = m_faces[toSize(face)];
  const std::size_t k = cornerOpposite(face, edge);
  const double opposite = m_edges[toSize(edge)].length;
  const double left = m_edges[toSize(f.edges[(k + 1) % 3])].length;
  const double right = m_edges[toSize(f.edges[(k + 2) % 3])].length;
  // Twice the product of the sides at the corner and the angle's cosine.
  const double cosine = left * left + (right - opposite) * (right + opposite);
  const double area = doubleArea(f);
  if (area > 0) return cosine / (2 * area);
  return ofNoArea > 0 && cosine != 0 ? std::copysign(ofNoArea, cosine) : 0;
}

bool Triangulation::canFlip(int edge) const {
  const Edge& e = m_edges[toSize(edge)];
  if (e.faceCount != 2 || !(e.length > 0)) return false;
  const double sum = cotangent(e.faces[0], edge, kInfinite) + cotangent(e.faces[1], edge, kInfinite);
  return sum < -kCotangentRounding;  // false, too, between two triangles of no area
}

// Turns the diagonal ij of the quadrilateral i l j k into kl.
bool Triangulation::flip(int edge) {
  Edge& diagonal = m_edges[toSize(edge)];
  const int first = diagonal.faces[0];
  const int second = diagonal.faces[1];
  Face& f = m_faces[toSize(first)];
  Face& g = m_faces[toSize(second)];
  const std::size_t cornerF = cornerOpposite(first, edge);
  const std::size_t cornerG = cornerOpposite(second, edge);
  const int k = f.nodes[cornerF];
  const int l = g.nodes[cornerG];
  if (k == l) return false;  // its ends would be one node
  const int i = f.nodes[(cornerF + 1) % 3];
  const int j = f.nodes[(cornerF + 2) % 3];
  const int jk = f.edges[(cornerF + 1) % 3];
  const int ik = f.edges[(cornerF + 2) % 3];
  const bool isAlike = g.nodes[(cornerG + 1) % 3] == i;
  const int jl = g.edges[(cornerG + (isAlike ? 1 : 2)) % 3];
  const int il = g.edges[(cornerG + (isAlike ? 2 : 1)) % 3];

  const auto along = [&](int toI, int toJ) {  // ij, from i
    const double fromI = m_edges[toSize(toI)].length;
    const double fromJ = m_edges[toSize(toJ)].length;
    return (diagonal.length + (fromI - fromJ) * ((fromI + fromJ) / diagonal.length)) / 2;
  };
  const double height = (doubleArea(f) + doubleArea(g)) / diagonal.length;
  const double length = std::hypot(along(ik, jk) - along(il, jl), height);
  if (!std::isfinite(length)) return false;

  f = {{k, l, i}, {il, ik, edge}};
  g = {{l, k, j}, {jk, jl, edge}};
  replaceFace(il, second, first);
  replaceFace(jk, first, second);
  diagonal.a = std::min(k, l);
  diagonal.b = std::max(k, l);
  diagonal.length = length;
  return true;
}

std::size_t Triangulation::cornerOpposite(int face, int edge) const {
  const auto& edges = m_faces[toSize(face)].edges;
  return edges[0] == edge ? 0 : (edges[1] == edge ? 1 : 2);
}

void Triangulation::replaceFace(int edge, int from, int to) {
  auto& faces = m_edges[toSize(edge)].faces;
  std::replace(faces.begin(), faces.end(), from, to);
}

void Triangulation::makeDelaunay() {
  std::vector<int> pending(m_edges.size());
  std::vector<bool> isPending(m_edges.size(), true);
  for (std::size_t e = 0; e < pending.size(); ++e) pending[e] = static_cast<int>(pending.size() - 1 - e);
  std::size_t flips = 0;
  while (!pending.empty() && flips < kFlipsPerEdge * m_edges.size()) {
    const int edge = pending.back();
    pending.pop_back();
    isPending[toSize(edge)] = false;
    if (!canFlip(edge) || !flip(edge)) continue;
    ++flips;
    for (const int face : m_edges[toSize(edge)].faces) {
      for (const int other : m_faces[toSize(face)].edges) {
        if (other == edge || isPending[toSize(other)]) continue;
        isPending[toSize(other)] = true;
        pending.push_back(other);
      }
    }
  }
}

std::vector<WeightedEdge> Triangulation::weights() const {
  std::vector<double> cotangents(m_edges.size(), 0);
  for (std::size_t f = 0; f < m_faces.size(); ++f) {
    for (const int edge : m_faces[f].edges) cotangents[toSize(edge)] += cotangent(static_cast<int>(f), edge, 0);
  }
  std::vector<WeightedEdge> edges;
  edges.reserve(m_edges.size());
  for (std::size_t e = 0; e < m_edges.size(); ++e) {
    if (cotangents[e] > kCotangentRounding) edges.push_back({m_edges[e].a, m_edges[e].b, cotangents[e] / 2});
  }
  return edges;
}

// After a flip two edges may join the same nodes.
std::vector<WeightedEdge> merged(std::vector<WeightedEdge> edges) {
  const auto ends = [](const WeightedEdge& edge) { return std::make_pair(edge.a, edge.b); };
  std::sort(edges.begin(), edges.end(), [&](const WeightedEdge& one, const WeightedEdge& other) {
    return std::make_pair(ends(one), one.weight) < std::make_pair(ends(other), other.weight);
  });
  std::vector<WeightedEdge> result;
  result.reserve(edges.size());
  for (const WeightedEdge& edge : edges) {
    if (!result.empty() && ends(result.back()) == ends(edge)) {
      result.back().weight += edge.weight;
    } else {
      result.push_back(edge);
    }
  }
  return result;
}

double lengthOf(const RestMesh& mesh, int edge) { return edge >= 0 ? mesh.edges()[toSize(edge)].length : 0; }

// The triangle in its plane: node 0 at the origin, node 1 on the first axis.
std::array<std::array<double, 2>, 3> layOut(const MeasuredTriangle& triangle) {
  const double base = triangle.lengths[2];
  if (!(base > 0)) return {};
  const double toThird = triangle.lengths[1];
  const double along = (base * base + (toThird - triangle.lengths[0]) * (toThird + triangle.lengths[0])) / (2 * base);
  const double height = 2 * triangleArea(base, toThird, triangle.lengths[0]) / base;
  return {{{0, 0}, {base, 0}, {along, height}}};
}

}  // namespace

std::vector<MeasuredTriangle> measuredTriangles(const RestMesh& mesh) {
  std::vector<MeasuredTriangle> triangles;
  triangles.reserve(mesh.triangles().size());
  for (const RestMesh::Triangle& triangle : mesh.triangles()) {
    if (triangle.isDoubled) continue;
    const auto& edges = triangle.edges;
    triangles.push_back(
        {triangle.nodes, {lengthOf(mesh, edges[0]), lengthOf(mesh, edges[1]), lengthOf(mesh, edges[2])}});
  }
  return triangles;
}

std::vector<MeasuredTriangle> orthotropicTriangles(const RestMesh& mesh, const std::vector<double>& warpCoordinate,
                                                   double warpDiffusivity, double weftDiffusivity) {
  std::vector<MeasuredTriangle> triangles = measuredTriangles(mesh);
  const double mean = std::sqrt(warpDiffusivity) * std::sqrt(weftDiffusivity);
  for (MeasuredTriangle& triangle : triangles) {
    const auto corners = layOut(triangle);
    const double u = warpCoordinate[toSize(triangle.nodes[0])];
    const double u1 = warpCoordinate[toSize(triangle.nodes[1])] - u;
    const double u2 = warpCoordinate[toSize(triangle.nodes[2])] - u;
    // The gradient, times base and height.
    const double warpX = u1 * corners[2][1];
    const double warpY = u2 * corners[1][0] - u1 * corners[2][0];
    const double steepness = std::hypot(warpX, warpY);
    const double base = triangle.lengths[2];
    const bool hasWarp = steepness > kCotangentRounding * base * corners[2][1];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!hasWarp) {
        triangle.lengths[k] /= std::sqrt(mean);
        continue;
      }
      const double x = corners[(k + 2) % 3][0] - corners[(k + 1) % 3][0];
      const double y = corners[(k + 2) % 3][1] - corners[(k + 1) % 3][1];
      const double alongWarp = (x * warpX + y * warpY) / steepness;
      const double alongWeft = (x * warpY - y * warpX) / steepness;
      triangle.lengths[k] = std::hypot(alongWarp / std::sqrt(warpDiffusivity), alongWeft / std::sqrt(weftDiffusivity));
    }
  }
  return triangles;
}

std::vector<WeightedEdge> delaunayWeights(const std::vector<MeasuredTriangle>& triangles) {
  Triangulation triangulation(triangles);
  triangulation.makeDelaunay();
  return merged(triangulation.weights());
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
