// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/audit/SweptFaces.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Layers.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kGap = -1;  // the first node of a gap between patches

// Only for the shape of the tree, which sorts by it: not finite would have no order.
btVector3 centreOf(const btSoftBody::Face& face) {
  const btVector3 centre = (face.m_n[0]->m_x + face.m_n[1]->m_x + face.m_n[2]->m_x) / 3;
  return std::isfinite(centre.length2()) ? centre : btVector3(0, 0, 0);
}

float floatNotAbove(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafter(rounded, -SweptBox::kInfinity) : rounded;
}

float floatNotBelow(double value) {
  const float rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value ? std::nextafter(rounded, SweptBox::kInfinity) : rounded;
}

SweptBox sweptBy(const SweptFaces::Position& position) {
  SweptBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const double start = position.at[k][0];
    const double end = position.at[k][1];
    if (!std::isfinite(start) || !std::isfinite(end)) return SweptBox();
    box.low[k] = floatNotAbove(std::min(start, end));
    box.high[k] = floatNotBelow(std::max(start, end));
  }
  return box;
}

// Fills up to whole blocks: what is compared together belongs to one patch.
template <int nodeCount>
SweptFaces::Range closePatch(SweptFaces::Parts<nodeCount>& parts) {
  const std::size_t begin = parts.boxes.size();
  typename SweptFaces::Parts<nodeCount>::Nodes gap;
  std::fill(std::begin(gap.node), std::end(gap.node), kGap);
  gap.face = kGap;
  parts.nodes.resize(SweptBoxes::wholeBlocks(parts.nodes.size()), gap);
  parts.boxes.resize(parts.nodes.size());
  return {begin, parts.nodes.size()};
}

// Returns whether all are finite.
template <int nodeCount>
bool refitParts(SweptFaces::Parts<nodeCount>& parts, const std::vector<SweptBox>& nodeBoxes) {
  bool allFinite = true;
  for (std::size_t i = 0; i < parts.nodes.size(); ++i) {
    if (parts.nodes[i].node[0] == kGap) continue;
    SweptBox box;
    bool isFinite = true;
    for (const int node : parts.nodes[i].node) {
      const SweptBox& nodeBox = nodeBoxes[static_cast<std::size_t>(node)];
      isFinite = isFinite && !nodeBox.isEmpty();
      box.include(nodeBox);
    }
    parts.boxes.set(i, isFinite ? box : SweptBox());
    allFinite = allFinite && isFinite;
  }
  return allFinite;
}

template <int nodeCount>
void leaveOutWithTheirFaces(SweptFaces::Parts<nodeCount>& parts, const SweptBoxes& faces) {
  for (std::size_t i = 0; i < parts.nodes.size(); ++i) {
    if (parts.nodes[i].node[0] == kGap) continue;
    if (faces[static_cast<std::size_t>(parts.nodes[i].face)].isEmpty()) parts.boxes.set(i, SweptBox());
  }
}

// Along the longest side, so the tree is as shallow as can be.
void splitAtMedian(int* first, int* middle, int* last, const std::vector<btVector3>& centres) {
  const auto centre = [&](int face) -> const btVector3& { return centres[static_cast<std::size_t>(face)]; };
  btVector3 low = centre(*first);
  btVector3 high = low;
  for (const int* face = first; face != last; ++face) {
    low.setMin(centre(*face));
    high.setMax(centre(*face));
  }
  const int axis = (high - low).maxAxis();
  std::nth_element(first, middle, last, [&](int a, int b) { return centre(a)[axis] < centre(b)[axis]; });
}

}  // namespace

void SweptFaces::build(const btSoftBody& body) {
  std::vector<btVector3> centres;
  std::vector<int> order;
  const std::vector<bool> doubled = areDoubled(nodesOfFaces(body));
  for (int f = 0; f < body.m_faces.size(); ++f) {
    centres.push_back(centreOf(body.m_faces[f]));
    if (!doubled[toSize(f)]) order.push_back(f);
  }
  build(body, std::move(order), &centres);
}

// Without centres the order is that of a tree already.
void SweptFaces::build(const btSoftBody& body, std::vector<int> order, const std::vector<btVector3>* centres) {
  m_body = &body;
  m_faceCount = body.m_faces.size();
  m_positions.resize(static_cast<std::size_t>(body.m_nodes.size()));
  m_nodeBoxes.resize(m_positions.size());
  m_faces = {};
  m_tree.clear();
  m_patches.clear();
  m_order = std::move(order);
  if (!m_order.empty()) buildTree(m_order.data(), m_order.data() + m_order.size(), body, centres);
  assignOwners();
  restart(body);
}

void SweptFaces::buildTree(int* first, int* last, const btSoftBody& body, const std::vector<btVector3>* centres) {
  const std::size_t index = m_tree.size();
  m_tree.emplace_back();
  m_tree[index].firstPatch = static_cast<int>(m_patches.size());
  if (last - first <= static_cast<std::ptrdiff_t>(kPatchFaces)) {
    addPatch(first, last, body);
    return;
  }
  int* const middle = first + (last - first) / 2;
  if (centres) splitAtMedian(first, middle, last, *centres);
  buildTree(first, middle, body, centres);
  m_tree[index].right = static_cast<int>(m_tree.size());
  buildTree(middle, last, body, centres);
  m_tree[index].patches = static_cast<int>(m_patches.size()) - m_tree[index].firstPatch;
}

void SweptFaces::addPatch(const int* first, const int* last, const btSoftBody& body) {
  for (; first != last; ++first) {
    const btSoftBody::Face& face = body.m_faces[*first];
    const auto nodeAt = [&](int corner) { return nodeIndex(body, face.m_n[corner]); };
    const int index = static_cast<int>(m_faces.nodes.size());
    m_faces.nodes.push_back({{nodeAt(0), nodeAt(1), nodeAt(2)}, index});
  }
  m_patches.push_back({{}, {}, closePatch(m_faces)});
}

void SweptFaces::assignOwners() {
  std::vector<bool> isOwned(m_positions.size(), false);
  std::set<std::pair<int, int>> edges;
  m_vertices = {};
  m_edges = {};
  for (Patch& patch : m_patches) {
    for (std::size_t f = patch.faces.begin; f < patch.faces.end; ++f) {
      const auto& corners = m_faces.nodes[f].node;
      const int owner = static_cast<int>(f);
      for (std::size_t k = 0; k < 3 && corners[0] != kGap; ++k) {
        const int node = corners[k];
        const int next = corners[(k + 1) % 3];
        if (!isOwned[static_cast<std::size_t>(node)]) m_vertices.nodes.push_back({{node}, owner});
        isOwned[static_cast<std::size_t>(node)] = true;
        if (edges.insert(std::minmax(node, next)).second) m_edges.nodes.push_back({{node, next}, owner});
      }
    }
    patch.vertices = closePatch(m_vertices);
    patch.edges = closePatch(m_edges);
  }
  m_patchBoxes.resize(m_patches.size());
}

bool SweptFaces::fits(const btSoftBody& body) const {
  return m_body == &body && static_cast<int>(m_positions.size()) == body.m_nodes.size() &&
         m_faceCount == body.m_faces.size();
}

void SweptFaces::restart(const btSoftBody& body) {
  advance(body);
  advance(body);
}

bool SweptFaces::advance(const btSoftBody& body) {
  bool moved = false;
  for (std::size_t i = 0; i < m_positions.size(); ++i) {
    const btVector3& now = body.m_nodes[static_cast<int>(i)].m_x;
    for (int k = 0; k < 3; ++k) {
      double(&at)[2] = m_positions[i].at[k];
      at[0] = at[1];
      at[1] = static_cast<double>(now[k]);
      moved |= !(at[0] == at[1]);
    }
  }
  return moved;
}

void SweptFaces::advance(const btScalar* places, const btVector3& origin) {
  m_origin = origin;
  for (Position& position : m_positions) {
    for (int k = 0; k < 3; ++k) {
      double(&at)[2] = position.at[k];
      at[0] = at[1];
      at[1] = static_cast<double>(origin[k]) + static_cast<double>(*places++);
    }
  }
}

void SweptFaces::stand() {
  for (Position& position : m_positions) {
    for (double(&at)[2] : position.at) at[0] = at[1];
  }
}

void SweptFaces::correct(const btSoftBody& body, bool arePinsLeft) {
  for (std::size_t i = 0; i < m_positions.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[static_cast<int>(i)];
    if (arePinsLeft && !(node.m_im > 0)) continue;
    const btVector3& now = node.m_x;
    for (int k = 0; k < 3; ++k) {
      double(&at)[2] = m_positions[i].at[k];
      if (static_cast<btScalar>(at[1]) != now[k]) at[1] = static_cast<double>(now[k]);
    }
  }
}

void SweptFaces::refit() {
  for (std::size_t i = 0; i < m_positions.size(); ++i) m_nodeBoxes[i] = sweptBy(m_positions[i]);
  refitParts(m_vertices, m_nodeBoxes);
  refitParts(m_edges, m_nodeBoxes);
  if (!refitParts(m_faces, m_nodeBoxes)) {
    leaveOutWithTheirFaces(m_vertices, m_faces.boxes);
    leaveOutWithTheirFaces(m_edges, m_faces.boxes);
  }
  for (std::size_t i = m_tree.size(); i-- > 0;) {
    TreeNode& node = m_tree[i];
    if (node.isLeaf()) {
      node.box = boxOfPatch(m_patches[static_cast<std::size_t>(node.firstPatch)]);
      m_patchBoxes[static_cast<std::size_t>(node.firstPatch)] = node.box;
    } else {
      node.box = m_tree[i + 1].box;
      node.box.include(m_tree[static_cast<std::size_t>(node.right)].box);
    }
  }
}

// Of its nodes that are finite: more than needed where a face is left out, which costs time only.
SweptBox SweptFaces::boxOfPatch(const Patch& patch) const {
  SweptBox box;
  for (std::size_t f = patch.faces.begin; f < patch.faces.end && m_faces.nodes[f].node[0] != kGap; ++f) {
    for (const int node : m_faces.nodes[f].node) box.include(m_nodeBoxes[static_cast<std::size_t>(node)]);
  }
  return box;
}

void SweptFaces::transferState(StateArchive& archive, const btSoftBody& body) {
  std::vector<int> order = m_order;
  std::vector<Position> positions = m_positions;
  order.resize(layersOf(body).size());
  positions.resize(static_cast<std::size_t>(body.m_nodes.size()));
  std::vector<bool> isKnown(static_cast<std::size_t>(body.m_faces.size()), false);
  for (int& face : order) {
    face = archive.place(face, body.m_faces.size(), "face of an audit");
    if (isKnown[static_cast<std::size_t>(face)]) archive.fail("a face is in an audit twice");
    isKnown[static_cast<std::size_t>(face)] = true;
  }
  btVector3 origin = m_origin;
  archive.local(origin);
  for (Position& position : positions) {
    for (auto& axis : position.at) archive.value(axis[0], axis[1]);
  }
  if (!archive.isRestoring()) return;
  build(body, std::move(order), nullptr);
  m_positions = std::move(positions);
  m_origin = origin;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
