// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/ClothPatch.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/mesh/LooseNodes.h"
#include "bullet_wetcloth/water/DryMass.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// The neighbour that a spring of a family reaches from (i, j).
struct Offset {
  int i;
  int j;
};

// A family's springs in one row, from (i, j). Bullet solves links one after the other, and a link that shares a node
// with the one before waits for its result: so every other link along the family's direction comes first.
void appendRow(btSoftBody& body, const ClothPatch& patch, int j, Offset offset, btSoftBody::Material* material,
               bool isBending) {
  if (j + offset.j >= patch.rows) return;
  const int stride = std::abs(offset.i);
  const int first = offset.i < 0 ? stride : 0;
  const int last = patch.columns - (offset.i > 0 ? stride : 0);
  for (int parity = 0; parity < 2; ++parity) {
    for (int i = first; i < last; ++i) {
      const int block = stride == 0 ? i : i / stride;
      if (block % 2 != parity) continue;
      body.appendLink(patch.node(i, j), patch.node(i + offset.i, j + offset.j), material);
      // A signed one-bit field: -1 is its only other value.
      body.m_links[body.m_links.size() - 1].m_bbending = isBending ? -1 : 0;
    }
  }
}

// Row by row, all families of a row together, so that its nodes are still in the cache.
void appendSprings(btSoftBody& body, const ClothPatch& patch) {
  btSoftBody::Material* const mechanical = body.m_materials[0];
  btSoftBody::Material* const shear = body.appendMaterial();
  btSoftBody::Material* const flexion = body.appendMaterial();
  mechanical->m_kLST = static_cast<btScalar>(patch.mechanicalStiffness);
  shear->m_kLST = static_cast<btScalar>(patch.shearStiffness);
  flexion->m_kLST = static_cast<btScalar>(patch.flexionStiffness);
  for (int j = 0; j < patch.rows; ++j) {
    appendRow(body, patch, j, {1, 0}, mechanical, false);
    appendRow(body, patch, j, {0, 1}, mechanical, false);
    appendRow(body, patch, j, {1, 1}, shear, false);
    appendRow(body, patch, j, {-1, 1}, shear, false);
    appendRow(body, patch, j, {2, 0}, flexion, true);
    appendRow(body, patch, j, {0, 2}, flexion, true);
  }
}

// All diagonals run the same way, so that every inner node has six triangles and the same share of the area.
void appendFaces(btSoftBody& body, const ClothPatch& patch) {
  for (int j = 0; j + 1 < patch.rows; ++j) {
    for (int i = 0; i + 1 < patch.columns; ++i) {
      body.appendFace(patch.node(i, j), patch.node(i + 1, j), patch.node(i + 1, j + 1));
      body.appendFace(patch.node(i, j), patch.node(i + 1, j + 1), patch.node(i, j + 1));
    }
  }
}

std::vector<btVector3> nodePositions(const ClothPatch& patch) {
  std::vector<btVector3> positions;
  positions.reserve(static_cast<std::size_t>(patch.nodeCount()));
  for (int j = 0; j < patch.rows; ++j) {
    for (int i = 0; i < patch.columns; ++i) {
      const btScalar u = static_cast<btScalar>(i) / static_cast<btScalar>(patch.columns - 1);
      const btScalar v = static_cast<btScalar>(j) / static_cast<btScalar>(patch.rows - 1);
      positions.push_back(patch.origin + patch.edgeU * u + patch.edgeV * v);
    }
  }
  return positions;
}

void requireValidCounts(const ClothPatch& patch) {
  if (patch.columns < 2) rejectValue("ClothPatch.columns", patch.columns, ">= 2");
  if (patch.rows < 2) rejectValue("ClothPatch.rows", patch.rows, ">= 2");
  constexpr int kMostNodes = 1 << 26;  // 12 links a node must stay countable in an int
  if (patch.columns > kMostNodes / patch.rows) {
    rejectValue("ClothPatch.columns * rows", static_cast<long long>(patch.columns) * patch.rows,
                "at most " + std::to_string(kMostNodes));
  }
}

void requireValid(const ClothPatch& patch) {
  requireValidCounts(patch);
  if (!isFinite(patch.origin)) rejectValue("ClothPatch.origin", "not finite", "finite");
  const btScalar area = patch.edgeU.cross(patch.edgeV).length();
  if (!(std::isfinite(area) && area > 0)) {
    rejectValue("|ClothPatch.edgeU x edgeV|", area, "finite and > 0: the edges span the patch");
  }
  requirePositive("ClothPatch.arealDensity", patch.arealDensity);
  const auto requireStiffness = [](const char* field, double value) {
    if (!(static_cast<btScalar>(value) > 0 && value <= 1)) rejectValue(field, value, "in (0, 1] as Bullet's scalar");
  };
  requireStiffness("ClothPatch.mechanicalStiffness", patch.mechanicalStiffness);
  requireStiffness("ClothPatch.shearStiffness", patch.shearStiffness);
  requireStiffness("ClothPatch.flexionStiffness", patch.flexionStiffness);
  for (const int node : patch.pinnedNodes) {
    if (node < 0 || node >= patch.nodeCount()) {
      rejectValue("ClothPatch.pinnedNodes", node, "in [0, " + std::to_string(patch.nodeCount()) + ")");
    }
  }
}

int cornerNode(const ClothPatch& patch, ClothPatch::Corner corner) {
  const bool isRight = corner == ClothPatch::Corner::bottomRight || corner == ClothPatch::Corner::topRight;
  const bool isTop = corner == ClothPatch::Corner::topLeft || corner == ClothPatch::Corner::topRight;
  return patch.node(isRight ? patch.columns - 1 : 0, isTop ? patch.rows - 1 : 0);
}

std::vector<int> edgeNodes(const ClothPatch& patch, ClothPatch::Edge edge) {
  std::vector<int> nodes;
  if (edge == ClothPatch::Edge::left || edge == ClothPatch::Edge::right) {
    const int i = edge == ClothPatch::Edge::left ? 0 : patch.columns - 1;
    for (int j = 0; j < patch.rows; ++j) nodes.push_back(patch.node(i, j));
  } else {
    const int j = edge == ClothPatch::Edge::bottom ? 0 : patch.rows - 1;
    for (int i = 0; i < patch.columns; ++i) nodes.push_back(patch.node(i, j));
  }
  return nodes;
}

// A body that has never stepped may have its inverse masses written directly.
void pin(btSoftBody& body, const ClothPatch& patch) {
  for (const ClothPatch::Corner corner : patch.pinnedCorners) body.m_nodes[cornerNode(patch, corner)].m_im = 0;
  for (const ClothPatch::Edge edge : patch.pinnedEdges) {
    for (const int node : edgeNodes(patch, edge)) body.m_nodes[node].m_im = 0;
  }
  for (const int node : patch.pinnedNodes) body.m_nodes[node].m_im = 0;
}

void setMasses(btSoftBody& body, double arealDensity) {
  const std::vector<double> areas = nodeAreas(body);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double mass = arealDensity * areas[i];
    const btScalar inverseMass = static_cast<btScalar>(1 / mass);
    if (!(inverseMass > 0 && std::isfinite(inverseMass))) {
      rejectValue("ClothPatch.arealDensity = " + std::to_string(arealDensity) + " on a node's area", mass,
                  "a mass [kg] that has an inverse; where it is 0, the patch is too far from 0 for its size");
    }
    body.m_nodes[static_cast<int>(i)].m_im = inverseMass;
  }
}

}  // namespace

long long ClothPatch::springCount(Spring kind) const {
  const long long m = columns;
  const long long n = rows;
  switch (kind) {
    case Spring::shear: return 2 * (m - 1) * (n - 1);
    case Spring::flexion: return (m - 2) * n + m * (n - 2);
    case Spring::mechanical: break;
  }
  return (m - 1) * n + m * (n - 1);
}

std::unique_ptr<btSoftBody> ClothPatch::build(btSoftBodyWorldInfo& worldInfo) const {
  requireValid(*this);
  auto body = looseNodes(worldInfo, nodePositions(*this));
  const long long springs = springCount(Spring::mechanical) + springCount(Spring::shear) + springCount(Spring::flexion);
  body->m_links.reserve(static_cast<int>(springs));
  body->m_faces.reserve(2 * (columns - 1) * (rows - 1));
  appendSprings(*body, *this);
  appendFaces(*body, *this);
  setMasses(*body, arealDensity);
  pin(*body, *this);
  body->updateConstants();
  return body;
}

std::vector<std::array<float, 2>> ClothPatch::textureCoordinates() const {
  requireValidCounts(*this);
  std::vector<std::array<float, 2>> coordinates;
  coordinates.reserve(static_cast<std::size_t>(nodeCount()));
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      coordinates.push_back({static_cast<float>(i) / static_cast<float>(columns - 1),
                             static_cast<float>(j) / static_cast<float>(rows - 1)});
    }
  }
  return coordinates;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
