#include "bullet_wetcloth/effects/SweptFaces.h"

#include <cmath>
#include <set>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

bool isFinite(const btScalar (&point)[3]) {
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

// Only for the shape of the tree, which sorts by it: not finite would have no order.
btVector3 centreOf(const btSoftBody::Face& face) {
  const btVector3 centre = (face.m_n[0]->m_x + face.m_n[1]->m_x + face.m_n[2]->m_x) / 3;
  return std::isfinite(centre.length2()) ? centre : btVector3(0, 0, 0);
}

}  // namespace

void SweptFaces::build(const btSoftBody& body) {
  m_body = &body;
  m_faces.resize(static_cast<std::size_t>(body.m_faces.size()));
  m_positions.resize(static_cast<std::size_t>(body.m_nodes.size()));
  std::vector<btVector3> centres(m_faces.size());
  std::vector<int> order(m_faces.size());
  for (std::size_t f = 0; f < m_faces.size(); ++f) {
    const btSoftBody::Face& face = body.m_faces[static_cast<int>(f)];
    m_faces[f] = Face();
    for (std::size_t k = 0; k < 3; ++k) m_faces[f].nodes[k] = static_cast<int>(face.m_n[k] - &body.m_nodes[0]);
    centres[f] = centreOf(face);
    order[f] = static_cast<int>(f);
  }
  assignOwners();
  m_tree.clear();
  m_tree.reserve(2 * m_faces.size());
  m_leafOfFace.resize(m_faces.size());
  if (!order.empty()) buildTree(order.data(), order.data() + order.size(), centres);
  restart(body);
}

void SweptFaces::assignOwners() {
  std::vector<bool> isOwned(m_positions.size(), false);
  std::set<std::pair<int, int>> edges;
  m_vertices.clear();
  m_edges.clear();
  for (Face& face : m_faces) {
    face.vertexBegin = m_vertices.size();
    face.edgeBegin = m_edges.size();
    for (std::size_t k = 0; k < 3; ++k) {
      const int node = face.nodes[k];
      const int next = face.nodes[(k + 1) % 3];
      if (!isOwned[static_cast<std::size_t>(node)]) m_vertices.push_back({node, {}});
      isOwned[static_cast<std::size_t>(node)] = true;
      if (edges.insert(std::minmax(node, next)).second) m_edges.push_back({{node, next}, {}});
    }
    face.vertexEnd = m_vertices.size();
    face.edgeEnd = m_edges.size();
  }
}

// Splits at the median along the longest side, so the tree is as shallow as can be.
void SweptFaces::buildTree(int* first, int* last, const std::vector<btVector3>& centres) {
  const std::size_t index = m_tree.size();
  m_tree.emplace_back();
  if (last - first == 1) {
    m_tree[index].face = *first;
    m_leafOfFace[static_cast<std::size_t>(*first)] = static_cast<int>(index);
    return;
  }
  const auto centre = [&](int face) -> const btVector3& { return centres[static_cast<std::size_t>(face)]; };
  btVector3 low = centre(*first);
  btVector3 high = low;
  for (const int* face = first; face != last; ++face) {
    low.setMin(centre(*face));
    high.setMax(centre(*face));
  }
  const int axis = (high - low).maxAxis();
  int* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last, [&](int a, int b) { return centre(a)[axis] < centre(b)[axis]; });
  buildTree(first, middle, centres);
  m_tree[index].right = static_cast<int>(m_tree.size());
  buildTree(middle, last, centres);
}

bool SweptFaces::fits(const btSoftBody& body) const {
  return m_body == &body && static_cast<int>(m_positions.size()) == body.m_nodes.size() &&
         static_cast<int>(m_faces.size()) == body.m_faces.size();
}

void SweptFaces::restart(const btSoftBody& body) {
  advance(body);
  advance(body);
}

bool SweptFaces::advance(const btSoftBody& body) {
  bool moved = false;
  for (std::size_t i = 0; i < m_positions.size(); ++i) {
    const btVector3& now = body.m_nodes[static_cast<int>(i)].m_x;
    Position& position = m_positions[i];
    for (int k = 0; k < 3; ++k) {
      position.start[k] = position.end[k];
      position.end[k] = now[k];
      moved |= !(position.start[k] == position.end[k]);
    }
  }
  return moved;
}

SweptBox SweptFaces::boxOfNode(int node) const {
  const Position& at = position(node);
  SweptBox box;
  if (!isFinite(at.start) || !isFinite(at.end)) return box;
  box.include(at.start);
  box.include(at.end);
  return box;
}

void SweptFaces::refit() {
  for (Vertex& vertex : m_vertices) vertex.box = boxOfNode(vertex.node);
  for (Edge& edge : m_edges) {
    edge.box = boxOfNode(edge.nodes[0]);
    edge.box.include(boxOfNode(edge.nodes[1]));
  }
  for (std::size_t i = m_tree.size(); i-- > 0;) {
    TreeNode& node = m_tree[i];
    node.box = SweptBox();
    if (!node.isLeaf()) {
      node.box.include(m_tree[i + 1].box);
      node.box.include(m_tree[static_cast<std::size_t>(node.right)].box);
      continue;
    }
    bool finite = true;
    for (const int corner : face(node.face).nodes) {
      const SweptBox box = boxOfNode(corner);
      finite = finite && !box.isEmpty();
      node.box.include(box);
    }
    if (!finite) node.box = SweptBox();
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
