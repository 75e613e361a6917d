// SPDX-License-Identifier: Zlib
// A user's vertex buffer: what lands where in it, and what is refused.

#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <BulletSoftBody/btDefaultSoftBodySolver.h>

#include <limits>

namespace wetcloth_test::vertex_buffer_test {
namespace {

using wetcloth::fillVertexBuffer;
using wetcloth::VertexAttribute;
using wetcloth::VertexBuffer;

constexpr int kStride = 12;
constexpr float kUntouched = -77;

/// Ten floats of twelve: position at 0, normal at 3, colour at 7, roughness at 11; 6 and 10 are somebody else's.
struct Interleaved {
  std::vector<float> floats;
  VertexBuffer buffer;

  explicit Interleaved(int nodes) : floats(std::size_t(nodes * kStride), kUntouched) {
    buffer.base = floats.data();
    buffer.vertexCount = nodes;
    buffer.position = {0, kStride};
    buffer.normal = {3, kStride};
    buffer.colour = {7, kStride};
    buffer.roughness = {11, kStride};
  }
  float at(int node, int place) const { return floats[std::size_t(node * kStride + place)]; }
  btVector3 vector(int node, int place) const {
    return btVector3(btScalar(at(node, place)), btScalar(at(node, place + 1)), btScalar(at(node, place + 2)));
  }
};

wetcloth::Fabric colourful() {
  wetcloth::Fabric fabric = wetcloth::Fabric::cotton();
  fabric.dryColour = {0.8, 0.5, 0.1};
  fabric.dryRoughness = 0.9;
  return fabric;
}

class FilledVertexBuffer {
 protected:
  ClothScene scene{GetParam(), btVector3(0, 0, 0), levelPatch(7, 1), colourful()};
  const int nodes = scene.cloth().nodeCount();
};

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, HasWhatTheClothSaysOfEachNode) {
  std::vector<double> held;
  for (int i = 0; i < nodes; ++i) held.push_back(scene.cloth().capacity(i) * i / (nodes - 5.0));  // some too full
  scene.cloth().setHeld(held);
  scene.step(3);
  Interleaved filled(nodes);
  fillVertexBuffer(scene.cloth(), filled.buffer);
  for (int i = 0; i < nodes; ++i) {
    const wetcloth::Colour colour = scene.cloth().colour(i);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(filled.at(i, axis), float(scene.node(i).m_x[axis]));
      EXPECT_EQ(filled.at(i, 3 + axis), float(scene.node(i).m_n[axis]));
    }
    EXPECT_FLOAT_EQ(filled.at(i, 7), float(colour.r));
    EXPECT_FLOAT_EQ(filled.at(i, 8), float(colour.g));
    EXPECT_FLOAT_EQ(filled.at(i, 9), float(colour.b));
    EXPECT_FLOAT_EQ(filled.at(i, 11), float(scene.cloth().roughness(i)));
    EXPECT_EQ(filled.at(i, 6), kUntouched);
    EXPECT_EQ(filled.at(i, 10), kUntouched);
  }
  EXPECT_LT(filled.at(nodes - 1, 7), filled.at(0, 7));    // wet is darker
  EXPECT_LT(filled.at(nodes - 1, 11), filled.at(0, 11));  // and smoother
}

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, NormalsOfAFlatPatchPointAcrossIt) {
  scene.step(1);
  Interleaved filled(nodes);
  fillVertexBuffer(scene.cloth(), filled.buffer);
  const float side = filled.at(0, 4) > 0 ? 1.0F : -1.0F;
  for (int i = 0; i < nodes; ++i) {
    EXPECT_NEAR(filled.at(i, 3), 0, 1e-5);
    EXPECT_NEAR(filled.at(i, 4), side, 1e-5);
    EXPECT_NEAR(filled.at(i, 5), 0, 1e-5);
  }
}

// Bent to an arc of radius 1 about the z axis: the normal is the direction from the axis.
TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, NormalsOfACurvedPatchPointFromItsAxis) {
  for (int i = 0; i < nodes; ++i) {
    const btScalar angle = scene.node(i).m_x.x();
    scene.node(i).m_x = btVector3(std::sin(angle), std::cos(angle), scene.node(i).m_x.z());
  }
  scene.body().updateNormals();
  Interleaved filled(nodes);
  fillVertexBuffer(scene.cloth(), filled.buffer);
  const btScalar side = filled.vector(0, 3).dot(filled.vector(0, 0)) > 0 ? btScalar(1) : btScalar(-1);
  for (int i = 0; i < nodes; ++i) {
    const btVector3 normal = filled.vector(i, 3) * side;
    const btVector3 outward = btVector3(scene.node(i).m_x.x(), scene.node(i).m_x.y(), 0);
    EXPECT_NEAR(double(normal.length()), 1, 1e-5);
    // Facets are 1/6 rad wide: at the border a normal is that of one facet, half of that off.
    EXPECT_GT(double(normal.dot(outward)), std::cos(1.0 / 12) - 1e-4) << i;
  }
  EXPECT_GT(double((filled.vector(24, 3) * side).dot(btVector3(0, 1, 0))), 0.9999);  // the middle, by symmetry
}

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, PositionsAndNormalsAreThoseOfBulletsOwnCopy) {
  scene.step(2);
  Interleaved ours(nodes);
  ours.buffer.colour.stride = ours.buffer.roughness.stride = 0;
  Interleaved bullets(nodes);
  fillVertexBuffer(scene.cloth(), ours.buffer);
  btCPUVertexBufferDescriptor descriptor(bullets.floats.data(), 0, kStride, 3, kStride);
  btDefaultSoftBodySolver().copySoftBodyToVertexBuffer(&scene.body(), &descriptor);
  EXPECT_EQ(ours.floats, bullets.floats);
}

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, WhatIsNotWantedIsNotWritten) {
  Interleaved filled(nodes);
  filled.buffer.position.stride = filled.buffer.normal.stride = filled.buffer.colour.stride = 0;
  fillVertexBuffer(scene.cloth(), filled.buffer);
  for (int i = 0; i < nodes; ++i) {
    for (int place = 0; place < 11; ++place) ASSERT_EQ(filled.at(i, place), kUntouched);
    EXPECT_FLOAT_EQ(filled.at(i, 11), 0.9F);
  }
}

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, MayBePlanesOneAfterTheOther) {
  std::vector<float> floats(std::size_t(10 * nodes), kUntouched);
  const VertexBuffer planes = {floats.data(), nodes, {0, 3}, {3 * nodes, 3}, {6 * nodes, 3}, {9 * nodes, 1}};
  fillVertexBuffer(scene.cloth(), planes);
  EXPECT_EQ(floats[3], float(scene.node(1).m_x.x()));
  EXPECT_FLOAT_EQ(floats[std::size_t(6 * nodes)], 0.8F);
  EXPECT_FLOAT_EQ(floats.back(), 0.9F);
  for (std::size_t i = std::size_t(6 * nodes); i < floats.size(); ++i) EXPECT_NE(floats[i], kUntouched);
}

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, NodesThatACutHasJustMadeAreDry) {
  scene.cloth().setSaturation(1);
  scene.body().appendNode(btVector3(0, 1, 0), 1);
  Interleaved filled(nodes + 1);
  fillVertexBuffer(scene.cloth(), filled.buffer);
  EXPECT_FLOAT_EQ(filled.at(nodes, 7), 0.8F);
  EXPECT_LT(filled.at(nodes - 1, 7), 0.8F);
}

struct BadBuffer {
  const char* word;
  void (*spoil)(VertexBuffer&);
};

TEST_F_IN_EVERY_WORLD(FilledVertexBuffer, BadBuffersAreRefusedAndNothingIsWritten) {
  const BadBuffer bads[] = {
      {"VertexBuffer.base", [](VertexBuffer& b) { b.base = nullptr; }},
      {"VertexBuffer.vertexCount = 48: must be the number of nodes, 49", [](VertexBuffer& b) { --b.vertexCount; }},
      {"VertexBuffer.vertexCount = 50", [](VertexBuffer& b) { ++b.vertexCount; }},
      {"VertexBuffer.vertexCount = 0", [](VertexBuffer& b) { b.vertexCount = 0; }},
      {"VertexBuffer.position.stride = 2", [](VertexBuffer& b) { b.position.stride = 2; }},
      {"VertexBuffer.normal.stride = -12", [](VertexBuffer& b) { b.normal.stride = -12; }},
      {"VertexBuffer.colour.stride = 1", [](VertexBuffer& b) { b.colour.stride = 1; }},
      {"VertexBuffer.roughness.stride = -1", [](VertexBuffer& b) { b.roughness.stride = -1; }},
      {"VertexBuffer.position.offset = -1", [](VertexBuffer& b) { b.position.offset = -1; }},
      {"VertexBuffer.roughness.offset = -9", [](VertexBuffer& b) { b.roughness.offset = -9; }},
  };
  for (const BadBuffer& bad : bads) {
    Interleaved filled(nodes);
    bad.spoil(filled.buffer);
    const std::string text = rejection([&] { fillVertexBuffer(scene.cloth(), filled.buffer); });
    EXPECT_NE(text.find(bad.word), std::string::npos) << bad.word << " in: " << text;
    for (const float value : filled.floats) ASSERT_EQ(value, kUntouched) << bad.word;
  }
}

}  // namespace
}  // namespace wetcloth_test::vertex_buffer_test
