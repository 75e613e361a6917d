// SPDX-License-Identifier: Zlib
// Triangles from a file or from arrays, with their vertices in rows or in no order at all.

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/PackedLinks.h"
#include "command/scene/MeshBody.h"
#include "command/scene/ObjReader.h"
#include "tests/command/Command.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/Measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::meshes_in_rows_test {
namespace {

using wetcloth::findSlots;
using wetcloth::NodeSlots;
using wetcloth::PackedLinks;
using wetcloth::toSize;

constexpr int kColumns = 12;
constexpr int kRows = 9;
constexpr double kSpacing = 0.05;

// The vertices of an upright sheet, row by row from its upper edge, and which two triangles each of its squares has.
struct Sheet {
  std::vector<btVector3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

Sheet inRows() {
  Sheet sheet;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      sheet.vertices.emplace_back(btScalar(column * kSpacing), btScalar(-row * kSpacing), btScalar(0));
      if (row + 1 == kRows || column + 1 == kColumns) continue;
      const int k = row * kColumns + column;
      sheet.triangles.push_back({k, k + 1, k + kColumns});
      sheet.triangles.push_back({k + 1, k + kColumns + 1, k + kColumns});
    }
  }
  return sheet;
}

Sheet inNoOrder() {
  const Sheet rows = inRows();
  std::vector<int> number(rows.vertices.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(5));
  Sheet sheet = rows;
  for (std::size_t k = 0; k < number.size(); ++k) sheet.vertices[toSize(number[k])] = rows.vertices[k];
  for (auto& corners : sheet.triangles) {
    for (int& corner : corners) corner = number[toSize(corner)];
  }
  return sheet;
}

// By way of an OBJ file.
BodyBuilder fromFile(const Sheet& sheet) {
  return [sheet](btSoftBodyWorldInfo& info) {
    std::ostringstream text;
    for (const btVector3& v : sheet.vertices) text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const auto& [a, b, c] : sheet.triangles) text << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    const cli::TemporaryDirectory directory;
    return command::makeMeshBody(command::readObj(directory.write("sheet.obj", text.str())), 0.15, info);
  };
}

// As Bullet makes a body of a mesh.
BodyBuilder fromArrays(const Sheet& sheet) {
  return [sheet](btSoftBodyWorldInfo& info) {
    std::vector<btScalar> coordinates;
    std::vector<int> corners;
    for (const btVector3& v : sheet.vertices) coordinates.insert(coordinates.end(), {v.x(), v.y(), v.z()});
    for (const auto& triangle : sheet.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreateFromTriMesh(info, coordinates.data(), corners.data(),
                                                                          static_cast<int>(sheet.triangles.size())));
    body->generateBendingConstraints(2);
    body->setTotalMass(btScalar(0.05));
    return body;
  };
}

std::size_t linksInRuns(const btSoftBody& body, const NodeSlots& slots) {
  PackedLinks links;
  links.reset(body, slots);
  return links.inRuns();
}

TEST(MeshesInRows, AreFoundAsGrids) {
  btSoftBodyWorldInfo info;
  for (const BodyBuilder& builder : {fromFile(inRows()), fromArrays(inRows())}) {
    const auto body = builder(info);
    ASSERT_EQ(body->m_nodes.size(), kColumns * kRows);
    const NodeSlots slots = findSlots(*body);
    ASSERT_TRUE(slots.grid);
    EXPECT_EQ(slots.grid->columns, kColumns);
    EXPECT_EQ(linksInRuns(*body, slots), toSize(body->m_links.size()));
  }
}

TEST(MeshesInRows, LinksThatAreNotOfTheGridAreSolvedApart) {
  btSoftBodyWorldInfo info;
  const auto body = fromFile(inRows())(info);
  body->appendLink(0, kColumns * kRows - 1);
  body->appendLink(0, 1);  // a second one
  const NodeSlots slots = findSlots(*body);
  ASSERT_TRUE(slots.grid);
  EXPECT_EQ(linksInRuns(*body, slots), toSize(body->m_links.size()) - 2);
}

TEST(MeshesInRows, InNoOrderTheyAreNone) {
  btSoftBodyWorldInfo info;
  for (const BodyBuilder& builder : {fromFile(inNoOrder()), fromArrays(inNoOrder())}) {
    const auto body = builder(info);
    const NodeSlots slots = findSlots(*body);
    EXPECT_FALSE(slots.grid);
    EXPECT_EQ(linksInRuns(*body, slots), 0u);
  }
}

// Its upper row is pinned; the lower edge comes to rest where the links hold it, however the vertices are numbered.
TEST(MeshesInRows, AnyOrderHangsAndHolds) {
  for (const Sheet& sheet : {inRows(), inNoOrder()}) {
    for (const BodyBuilder& builder : {fromFile(sheet), fromArrays(sheet)}) {
      SolverScene scene;
      btSoftBody& body = scene.add(builder);
      body.m_cfg.kDP = btScalar(0.02);
      for (int k = 0; k < body.m_nodes.size(); ++k) {
        if (body.m_nodes[k].m_x.y() > btScalar(-0.1 * kSpacing)) body.setMass(k, 0);
      }
      scene.step(300);
      EXPECT_EQ(scene.solver().reasonNotTaken(body), "");
      EXPECT_LT(largestSpeed(body), 0.02);
      EXPECT_NEAR(totalLength(body) / totalRestLength(body), 1, 0.005);
      btScalar lowest = 0;
      for (int k = 0; k < body.m_nodes.size(); ++k) lowest = std::min(lowest, body.m_nodes[k].m_x.y());
      EXPECT_NEAR(-double(lowest) / (kSpacing * (kRows - 1)), 1, 0.02);
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::meshes_in_rows_test
