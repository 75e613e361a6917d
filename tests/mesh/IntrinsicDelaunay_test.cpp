// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/IntrinsicDelaunay.h"

#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace wetcloth_test::intrinsic_delaunay_test {

using namespace transport;

namespace {

using wetcloth::delaunayWeights;
using wetcloth::MeasuredTriangle;
using wetcloth::WeightedEdge;

using Point = std::array<double, 2>;

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

std::vector<MeasuredTriangle> measure(const std::vector<Point>& points, const std::vector<std::array<int, 3>>& faces) {
  std::vector<MeasuredTriangle> triangles;
  for (const auto& f : faces) {
    const Point& a = points[std::size_t(f[0])];
    const Point& b = points[std::size_t(f[1])];
    const Point& c = points[std::size_t(f[2])];
    triangles.push_back({f, {distance(b, c), distance(c, a), distance(a, b)}});
  }
  return triangles;
}

std::vector<Point> flatPoints(const Mesh& mesh) {
  std::vector<Point> points;
  for (const btVector3& p : mesh.points) points.push_back({double(p.x()), double(p.y())});
  return points;
}

double weightBetween(const std::vector<WeightedEdge>& edges, int a, int b) {
  for (const WeightedEdge& edge : edges) {
    if (edge.a == std::min(a, b) && edge.b == std::max(a, b)) return edge.weight;
  }
  return 0;
}

TEST(IntrinsicDelaunay, AnEquilateralTriangleHasHalfTheCotangentOf60Degrees) {
  const auto edges = delaunayWeights({{{0, 1, 2}, {2, 2, 2}}});
  ASSERT_EQ(edges.size(), 3u);
  for (const WeightedEdge& edge : edges) EXPECT_NEAR(edge.weight, 0.5 / std::sqrt(3.0), 1e-15);
}

TEST(IntrinsicDelaunay, AGridOfSquaresIsTheFivePointStencil) {
  const Mesh mesh = grid(4, 4, 3, 3);
  const auto edges = delaunayWeights(measure(flatPoints(mesh), mesh.faces));
  EXPECT_EQ(edges.size(), 24u) << "no diagonals";
  EXPECT_NEAR(weightBetween(edges, 5, 6), 1, 1e-12);
  EXPECT_NEAR(weightBetween(edges, 5, 9), 1, 1e-12);
  EXPECT_NEAR(weightBetween(edges, 0, 1), 0.5, 1e-12) << "border";
}

// A rhombus with the angles 40 and 140 degrees, split along its long diagonal: the short one is Delaunay, and from it
// the angles are 40 and 70 degrees.
TEST(IntrinsicDelaunay, FlipsTheLongDiagonalOfARhombus) {
  const double half = 20 * kPi / 180;
  const std::vector<Point> points = {
      {-std::cos(half), 0}, {0, -std::sin(half)}, {std::cos(half), 0}, {0, std::sin(half)}};
  const auto edges = delaunayWeights(measure(points, {{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(weightBetween(edges, 0, 2), 0);
  EXPECT_NEAR(weightBetween(edges, 1, 3), 1 / std::tan(2 * half), 1e-7);
  EXPECT_NEAR(weightBetween(edges, 0, 1), 0.5 * std::tan(half), 1e-7);
}

// With linear functions the Laplacian is exact: sum w_ij (x_j - x_i) = 0 inside, and sum w_ij (u_i - u_j)^2 is the area
// times the gradient squared, whatever the triangles are.
TEST(IntrinsicDelaunay, IsExactForLinearFunctionsOnObtuseMeshes) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    // A third of the spacing: points stay out of the circles over the border's edges, where nothing could be flipped.
    Mesh mesh = grid(9, 9, 1, 1, 0.33, seed);
    const std::vector<Point> points = flatPoints(mesh);
    const auto edges = delaunayWeights(measure(points, mesh.faces));
    std::vector<Point> sums(points.size(), Point{0, 0});
    double energy = 0;
    for (const WeightedEdge& edge : edges) {
      EXPECT_GT(edge.weight, 0);
      EXPECT_LT(edge.a, edge.b);
      const Point& a = points[std::size_t(edge.a)];
      const Point& b = points[std::size_t(edge.b)];
      for (std::size_t k = 0; k < 2; ++k) {
        sums[std::size_t(edge.a)][k] += edge.weight * (b[k] - a[k]);
        sums[std::size_t(edge.b)][k] -= edge.weight * (b[k] - a[k]);
      }
      const double difference = 3 * (b[0] - a[0]) - 2 * (b[1] - a[1]);
      energy += edge.weight * difference * difference;
    }
    // Weights below 1e-6 are left out: of a spacing of 1/8, at each of six edges.
    for (int i = 1; i < 8; ++i) {
      for (int j = 1; j < 8; ++j) {
        EXPECT_NEAR(sums[std::size_t(9 * j + i)][0], 0, 1e-6) << seed;
        EXPECT_NEAR(sums[std::size_t(9 * j + i)][1], 0, 1e-6) << seed;
      }
    }
    EXPECT_NEAR(energy, 13, 1e-4) << seed;
  }
}

// The same in the metric of the fabric: the energy is that of D, whatever the direction of the warp.
TEST(IntrinsicDelaunay, IsExactForLinearFunctionsInAnOrthotropicMetric) {
  const double warp = 9e-4;
  const double weft = 4e-4;
  for (const double degrees : {0.0, 30.0, 45.0, 110.0}) {
    TransportScene scene(grid(13, 13, 1, 1, 0.2, 7));
    const double c = std::cos(degrees * kPi / 180);
    const double s = std::sin(degrees * kPi / 180);
    std::vector<double> along;
    for (int i = 0; i < scene.count(); ++i) along.push_back(5 + c * scene.x(i) + s * scene.y(i));
    const auto edges = delaunayWeights(orthotropicTriangles(scene.cloth().restMesh(), along, warp, weft));
    double energy = 0;
    for (const WeightedEdge& edge : edges) {
      const double difference = scene.x(edge.a) - scene.x(edge.b);
      energy += std::sqrt(warp * weft) * edge.weight * difference * difference;
    }
    // Near the border a few obtuse angles stay, since the metric's circles are ellipses that reach in.
    EXPECT_NEAR(energy, c * c * warp + s * s * weft, 0.03 * warp) << degrees;
  }
}

// Away from corners a grid in line with the warp conducts D_warp dy/dx along it and D_weft dx/dy across.
TEST(IntrinsicDelaunay, ConductsAlongTheWarpWithItsOwnDiffusivity) {
  TransportScene scene(grid(5, 5, 1, 1));
  std::vector<double> along;
  for (int i = 0; i < scene.count(); ++i) along.push_back(scene.y(i));
  const auto edges = delaunayWeights(orthotropicTriangles(scene.cloth().restMesh(), along, 8, 2));
  EXPECT_NEAR(4 * weightBetween(edges, 12, 17), 8, 1e-5);
  EXPECT_NEAR(4 * weightBetween(edges, 12, 13), 2, 1e-5);
}

// A triangle across the warp has none: it conducts the geometric mean in every direction.
TEST(IntrinsicDelaunay, WithoutAWarpItIsIsotropic) {
  TransportScene scene(grid(3, 3, 1, 1));
  const auto edges = delaunayWeights(orthotropicTriangles(scene.cloth().restMesh(), std::vector<double>(9, 2.0), 8, 2));
  EXPECT_NEAR(weightBetween(edges, 4, 5), 1, 1e-5);
  EXPECT_NEAR(weightBetween(edges, 4, 7), 1, 1e-5);
}

TEST(IntrinsicDelaunay, WhatCannotBeFlippedConductsNothing) {
  // 120 degrees at node 2, opposite a border edge.
  const auto lone = delaunayWeights(measure({{0, 0}, {2, 0}, {1, 1 / std::sqrt(3.0)}}, {{0, 1, 2}}));
  EXPECT_EQ(weightBetween(lone, 0, 1), 0);
  EXPECT_NEAR(weightBetween(lone, 0, 2), 0.5 * std::sqrt(3.0), 1e-12);
  // The same edge in three triangles.
  const auto book =
      delaunayWeights(measure({{0, 0}, {2, 0}, {1, 0.1}, {1, 0.2}, {1, -0.1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(weightBetween(book, 0, 1), 0);
  EXPECT_GT(weightBetween(book, 0, 2), 0);
}

// A point on the side of another triangle, joined by a triangle of no area: the flip makes two true ones of the two.
TEST(IntrinsicDelaunay, MendsATriangleOfNoAreaWhoseLongSideIsShared) {
  const auto edges = delaunayWeights(measure({{0, 0}, {2, 0}, {1, 2}, {1, 0}}, {{0, 1, 2}, {0, 3, 1}}));
  EXPECT_NEAR(weightBetween(edges, 2, 3), 2 * 0.5 * 0.5, 1e-12) << "cot = 1/2 at both ends";
  EXPECT_EQ(weightBetween(edges, 0, 1), 0);
}

TEST(IntrinsicDelaunay, IsFiniteForWhateverItIsGiven) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<MeasuredTriangle>> inputs = {
      {},
      {{{0, 1, 2}, {0, 0, 0}}},
      {{{0, 1, 2}, {1, 1, 2}}},
      {{{0, 1, 2}, {1, 1, 5}}},
      {{{0, 1, 2}, {1, 1, 1e-300}}},
      {{{0, 1, 2}, {1e-200, 1e-200, 1e-200}}},
      {{{0, 1, 2}, {1e200, 1e200, 1e200}}},
      {{{0, 1, 2}, {nan, 1, 1}}},
      {{{0, 1, 2}, {inf, 1, 1}}},
      {{{0, 0, 2}, {1, 1, 1}}},
      {{{0, 1, 2}, {1, 1, 1}}, {{0, 1, 2}, {1, 1, 1}}},
      {{{0, 1, 2}, {1, 1, 1.99}}, {{0, 1, 2}, {1, 1, 1.99}}},
      {{{0, 1, 2}, {1, 1, 1}}, {{0, 1, 2}, {1, 1, 1}}, {{2, 1, 0}, {1, 1, 1.9}}},
      {{{0, 1, 2}, {0, 1, 1}}, {{1, 2, 3}, {2, 1, 1}}, {{0, 2, 3}, {1, 1, 2}}}};
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    for (const WeightedEdge& edge : delaunayWeights(inputs[k])) {
      EXPECT_TRUE(std::isfinite(edge.weight) && edge.weight > 0) << k;
      EXPECT_LT(edge.a, edge.b) << k;
    }
  }
}

// Random lengths make no surface at all.
TEST(IntrinsicDelaunay, EndsOnRandomLengths) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> length(0.5, 1.5);
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<MeasuredTriangle> triangles;
    for (const auto& face : grid(8, 8, 1, 1).faces) {
      triangles.push_back({face, {length(random), length(random), length(random)}});
    }
    for (const WeightedEdge& edge : delaunayWeights(triangles)) EXPECT_TRUE(std::isfinite(edge.weight));
  }
}

TEST(IntrinsicDelaunay, GivesEachPairOnce) {
  for (const auto& [name, mesh] : hardMeshes()) {
    TransportScene scene(mesh);
    const auto edges = delaunayWeights(measuredTriangles(scene.cloth().restMesh()));
    for (std::size_t e = 1; e < edges.size(); ++e) {
      EXPECT_LT(std::make_pair(edges[e - 1].a, edges[e - 1].b), std::make_pair(edges[e].a, edges[e].b)) << name;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::intrinsic_delaunay_test
