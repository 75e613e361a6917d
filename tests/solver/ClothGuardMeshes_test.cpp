// SPDX-License-Identifier: Zlib
// The guard keeps its promise for meshes of any kind.
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace wetcloth_test::cloth_guard_meshes_test {
namespace {

constexpr int kNodes = 10;  // of a side
constexpr double kSide = 0.6;

// Upright in waves, as triangles.
Triangles wavyTriangles(int n, double side, const btVector3& place) {
  wetcloth::ClothPatch patch = squarePatch(n);
  patch.edgeV = btVector3(0, 1, 0);
  Triangles mesh = Triangles::of(patch);
  for (btVector3& x : mesh.places) {
    x.setZ(btScalar(0.03 * std::sin(15 * double(x.y()) + 2 * double(x.x()))));
    x = x * btScalar(side) + place - btVector3(btScalar(side / 2), 0, 0);
  }
  return mesh;
}

BodyBuilder shuffled() {
  Triangles mesh = wavyTriangles(kNodes, kSide, btVector3(0, btScalar(0.05), 0));
  std::vector<int> newNumber(mesh.places.size());
  for (std::size_t k = 0; k < newNumber.size(); ++k) newNumber[k] = int(k);
  std::mt19937 random(7);
  std::shuffle(newNumber.begin(), newNumber.end(), random);
  Triangles other = mesh;
  for (std::size_t k = 0; k < newNumber.size(); ++k) other.places[std::size_t(newNumber[k])] = mesh.places[k];
  for (auto& face : other.faces) {
    for (int& node : face) node = newNumber[std::size_t(node)];
  }
  return other.builder();
}

BodyBuilder inTwoPieces() {
  Triangles mesh = wavyTriangles(7, 0.3, btVector3(0, btScalar(0.05), 0));
  const Triangles other = wavyTriangles(8, 0.3, btVector3(0, btScalar(0.4), 0));
  const int first = int(mesh.places.size());
  mesh.places.insert(mesh.places.end(), other.places.begin(), other.places.end());
  for (const auto& face : other.faces) mesh.faces.push_back({first + face[0], first + face[1], first + face[2]});
  return mesh.builder();
}

using Change = void (*)(btSoftBody&);

BodyBuilder changed(Change change) {
  return [change](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body = wavySheet(kNodes, kSide)(info);
    change(*body);
    return body;
  };
}

void makeAHole(btSoftBody& body) {
  for (int k = body.m_faces.size() - 1; k >= 0; --k) {
    const int node = numberOf(body, body.m_faces[k].m_n[0]);
    const int row = node / kNodes;
    const int column = node % kNodes;
    if (row < 3 || row > 6 || column < 3 || column > 6) continue;
    body.m_faces.swap(k, body.m_faces.size() - 1);
    body.m_faces.pop_back();
  }
}

void flipSomeFaces(btSoftBody& body) {
  for (int k = 0; k < body.m_faces.size(); k += 3) std::swap(body.m_faces[k].m_n[0], body.m_faces[k].m_n[1]);
}

void repeatSomeFaces(btSoftBody& body) {
  const int count = body.m_faces.size();
  for (int k = 0; k < count; k += 3) {
    const btSoftBody::Face face = body.m_faces[k];
    body.appendFace(numberOf(body, face.m_n[1]), numberOf(body, face.m_n[2]), numberOf(body, face.m_n[0]));
  }
}

// Squares that are cut along this diagonal or along the other one.
void changeDiagonals(btSoftBody& body) {
  body.m_faces.clear();
  for (int j = 0; j + 1 < kNodes; ++j) {
    for (int i = 0; i + 1 < kNodes; ++i) {
      const int a = kNodes * j + i;
      const int b = a + 1;
      const int c = a + kNodes + 1;
      const int d = a + kNodes;
      if ((i + j) % 2 == 0) {
        body.appendFace(a, b, c);
        body.appendFace(a, c, d);
      } else {
        body.appendFace(a, b, d);
        body.appendFace(b, c, d);
      }
    }
  }
}

struct Mesh {
  const char* name;
  BodyBuilder builder;
  int nodes = 9;  ///< of a side of the sheet beside it
};
std::ostream& operator<<(std::ostream& out, const Mesh& mesh) { return out << mesh.name; }

class ClothGuardMeshes : public testing::TestWithParam<Mesh> {};
INSTANTIATE_TEST_SUITE_P(, ClothGuardMeshes,
                         testing::Values(Mesh{"shuffled", shuffled()}, Mesh{"inTwoPieces", inTwoPieces(), 12},
                                         Mesh{"withAHole", changed(makeAHole)},
                                         Mesh{"withFlippedFaces", changed(flipSomeFaces)},
                                         Mesh{"withFacesTwice", changed(repeatSomeFaces)},
                                         Mesh{"withOtherDiagonals", changed(changeDiagonals)}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ClothGuardMeshes, FallIntoAHeapWithASheet) {
  for (const bool isGuarded : {true, false}) {
    GuardScene scene(isGuarded ? std::optional<Guard>(Guard()) : std::nullopt);
    btSoftBody& body = scene.add(GetParam().builder);
    ASSERT_EQ(scene.solver().reasonNotTaken(body), "");
    scene.add(wavySheet(GetParam().nodes, kSide, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.04))));
    scene.addFloor();
    PassageCheck& check = scene.watch();
    ASSERT_EQ(check.meetings(), 0);
    scene.step(60);
    if (isGuarded) {
      EXPECT_EQ(scene.passages(), 0);
      EXPECT_EQ(scene.totals().meeting, 0);
      EXPECT_EQ(scene.totals().forced, 0);
      EXPECT_EQ(scene.totals().halts, 0);
      EXPECT_LT(largestSpeed(body), 10);
    } else {
      EXPECT_GT(scene.passages(), 10) << "the scene has something to hold apart";
    }
  }
}

TEST(ClothGuardMeshesAlone, ABodyWithoutFacesMovesAsWithoutGuard) {
  std::vector<btScalar> ways[2];
  for (const bool isGuarded : {true, false}) {
    GuardScene scene(isGuarded ? std::optional<Guard>(Guard()) : std::nullopt);
    btSoftBody& rope = scene.add(hangingRope(10, 0.05, 0.002));
    btSoftBody& sheet = scene.add(levelSheet(8, 0.4, btVector3(0, btScalar(-0.3), 0)));
    scene.step(30);
    EXPECT_TRUE(isFinite(sheet));
    ways[isGuarded ? 0 : 1] = stateOf(rope);
  }
  EXPECT_TRUE(sameBits(ways[0], ways[1]));
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_meshes_test
