// SPDX-License-Identifier: Zlib
// Which triangles are behind others along a stream: known arrangements, and random ones against looking at each pair.

#include "bullet_wetcloth/numerics/Shelter.h"
#include "bullet_wetcloth/effects/Rain.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace wetcloth_test::shelter_test {
namespace {

using wetcloth::Shelter;

struct Mesh {
  std::vector<btVector3> positions;
  std::vector<Shelter::Triangle> triangles;

  /// Adds a level square of n x n cells and returns the number of its first triangle.
  std::size_t addSquare(int n, const btVector3& corner, btScalar side) {
    const int first = int(positions.size());
    const std::size_t firstTriangle = triangles.size();
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) positions.push_back(corner + btVector3(side * i / n, 0, side * j / n));
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = first + j * (n + 1) + i;
        triangles.push_back({a, a + 1, a + n + 1});
        triangles.push_back({a + 1, a + n + 2, a + n + 1});
      }
    }
    return firstTriangle;
  }

  std::vector<bool> sheltered(const btVector3& direction) const {
    Shelter shelter;
    shelter.resize(positions.size(), triangles.size());
    std::vector<bool> result;
    for (int time = 0; time < 2; ++time) {  // the second time must find nothing of the first
      shelter.update(positions, triangles, direction);
      result.clear();
      for (std::size_t f = 0; f < triangles.size(); ++f) result.push_back(shelter.isSheltered(f));
    }
    return result;
  }
};

int count(const std::vector<bool>& flags, std::size_t from, std::size_t to) {
  int sum = 0;
  for (std::size_t f = from; f < to; ++f) sum += flags[f] ? 1 : 0;
  return sum;
}

const btVector3 kDown(0, -1, 0);

TEST(Shelter, AFlatSheetSheltersNothing) {
  Mesh mesh;
  mesh.addSquare(8, btVector3(0, 0, 0), 1);
  for (const btVector3& direction : {kDown, btVector3(1, 0, 0), btVector3(btScalar(0.6), btScalar(-0.8), 0)}) {
    const std::vector<bool> sheltered = mesh.sheltered(direction);
    EXPECT_EQ(count(sheltered, 0, sheltered.size()), 0);
  }
}

TEST(Shelter, TheLowerOfTwoSheetsIsDryAndTheOtherWayRoundTheUpper) {
  Mesh mesh;
  mesh.addSquare(6, btVector3(0, 1, 0), 1);
  const std::size_t lower = mesh.addSquare(6, btVector3(0, 0, 0), 1);
  const std::vector<bool> fromAbove = mesh.sheltered(kDown);
  EXPECT_EQ(count(fromAbove, 0, lower), 0);
  EXPECT_EQ(count(fromAbove, lower, fromAbove.size()), 72);
  const std::vector<bool> fromBelow = mesh.sheltered(-kDown);
  EXPECT_EQ(count(fromBelow, 0, lower), 72);
  EXPECT_EQ(count(fromBelow, lower, fromBelow.size()), 0);
  const std::vector<bool> fromTheSide = mesh.sheltered(btVector3(1, 0, 0));
  EXPECT_EQ(count(fromTheSide, 0, fromTheSide.size()), 0) << "edge-on";
}

TEST(Shelter, ASmallRoofSheltersWhatIsUnderIt) {
  Mesh mesh;
  const std::size_t roof = mesh.addSquare(8, btVector3(0, 0, 0), 1);
  ASSERT_EQ(roof, 0u);
  mesh.addSquare(1, btVector3(btScalar(0.25), 1, btScalar(0.25)), btScalar(0.5));  // over 4 x 4 cells
  const std::vector<bool> sheltered = mesh.sheltered(kDown);
  EXPECT_EQ(count(sheltered, 0, 128), 32);
  EXPECT_EQ(count(sheltered, 128, 130), 0);
}

// Rain at 45 degrees throws the roof's shadow as far aside as it is high.
TEST(Shelter, TheShadowFollowsTheDirection) {
  Mesh mesh;
  mesh.addSquare(8, btVector3(0, 0, 0), 1);
  mesh.addSquare(8, btVector3(-2, 2, 0), 1);
  const btScalar half = btScalar(std::sqrt(0.5));
  const std::vector<bool> sheltered = mesh.sheltered(btVector3(half, -half, 0));
  EXPECT_EQ(count(sheltered, 0, 128), 128);
  EXPECT_EQ(count(mesh.sheltered(kDown), 0, 256), 0);
}

TEST(Shelter, TrianglesThatShareANodeDoNotShelterEachOther) {
  Mesh mesh;
  // Folded along the edge from node 0 to node 1.
  mesh.positions = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(0, btScalar(0.1), 1)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(count(mesh.sheltered(kDown), 0, 2), 0);
}

TEST(Shelter, LonelyAndDegenerateTrianglesAndPlacesThatAreNoNumbersDoNoHarm) {
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  const btScalar infinity = std::numeric_limits<btScalar>::infinity();
  const btScalar huge = btScalar(1e30);
  Mesh mesh;
  EXPECT_TRUE(mesh.sheltered(kDown).empty());
  mesh.positions = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(count(mesh.sheltered(kDown), 0, 1), 0);
  mesh.triangles = {{0, 0, 0}, {0, 0, 1}};
  EXPECT_EQ(count(mesh.sheltered(kDown), 0, 2), 0);

  mesh = Mesh();
  const std::size_t upper = mesh.addSquare(3, btVector3(0, 1, 0), 1);
  mesh.addSquare(3, btVector3(0, 0, 0), 1);
  for (const btScalar bad : {nan, infinity, -infinity, huge}) {
    mesh.positions[0].setX(bad);
    mesh.positions[20].setY(bad);
    const std::vector<bool> sheltered = mesh.sheltered(kDown);
    EXPECT_FALSE(sheltered[upper + 17]) << bad;
    EXPECT_TRUE(sheltered[35]) << bad << ": the far corners do not touch those nodes";
  }
}

// The rule once more, each triangle against each.
std::vector<bool> byPairs(const Mesh& mesh) {
  std::vector<bool> result(mesh.triangles.size(), false);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto corner = [&](std::size_t g, std::size_t k) { return mesh.positions[std::size_t(mesh.triangles[g][k])]; };
    const btVector3 p = (corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3;
    for (std::size_t g = 0; g < mesh.triangles.size(); ++g) {
      bool share = false;
      for (const int a : mesh.triangles[f]) {
        for (const int b : mesh.triangles[g]) share = share || a == b;
      }
      if (share) continue;
      const btVector3 a = corner(g, 0);
      const btVector3 n = (corner(g, 1) - a).cross(corner(g, 2) - a);
      if (n.y() == 0) continue;
      // Where the vertical through p meets the plane of g.
      const btVector3 hit = p + btVector3(0, n.dot(a - p) / n.y(), 0);
      bool isInside = hit.y() > p.y();
      for (std::size_t k = 0; k < 3; ++k) {
        const btVector3 from = corner(g, k);
        const btVector3 to = corner(g, (k + 1) % 3);
        isInside = isInside && (to - from).cross(hit - from).dot(n) >= 0;
      }
      result[f] = result[f] || isInside;
    }
  }
  return result;
}

TEST(Shelter, AgreesWithEachPairOnRandomTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  int wrong = 0;
  int dry = 0;
  int all = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Mesh mesh;
    const int triangles = 1 + trial;
    const double size = trial % 3 == 0 ? 0.02 : trial % 3 == 1 ? 0.2 : 1.0;
    for (int f = 0; f < triangles; ++f) {
      const btVector3 centre(btScalar(place(random)), btScalar(place(random)), btScalar(place(random)));
      for (int k = 0; k < 3; ++k) {
        mesh.positions.push_back(centre + btScalar(size) * btVector3(btScalar(place(random)), btScalar(place(random)),
                                                                     btScalar(place(random))));
      }
      mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const std::vector<bool> found = mesh.sheltered(kDown);
    const std::vector<bool> expected = byPairs(mesh);
    for (std::size_t f = 0; f < found.size(); ++f) {
      wrong += found[f] != expected[f] ? 1 : 0;
      dry += expected[f] ? 1 : 0;
      ++all;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(dry, all / 10) << "the arrangements are worth asking about";
  EXPECT_LT(dry, 9 * all / 10);
}

TEST(ShelterInRain, OfAClothFoldedOnceHalfCatches) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(9, 1), wetcloth::Fabric::cotton(),
                   wetcloth::Hook::manual);
  for (int i = 0; i < 81; ++i) {  // the half x > 0 over the half x < 0
    btVector3& x = scene.node(i).m_x;
    if (x.x() > 0) x.setValue(-x.x(), btScalar(0.1), x.z());
  }
  wetcloth::Rain::Parameters parameters;
  wetcloth::Rain& open = scene.cloth().add<wetcloth::Rain>(parameters);
  parameters.selfShelter = true;
  wetcloth::Rain& sheltered = scene.cloth().add<wetcloth::Rain>(parameters);
  scene.preTick(1);
  EXPECT_NEAR(open.caught(), 2.8e-3, 1e-8);
  // Next to the fold the two layers share its nodes, so that triangles in a column of 1/8 m^2 may not be sheltered.
  EXPECT_GE(sheltered.caught(), 2.8e-3 * 0.5 - 1e-8);
  EXPECT_LE(sheltered.caught(), 2.8e-3 * (0.5 + 0.125) + 1e-8);
}

}  // namespace
}  // namespace wetcloth_test::shelter_test
