// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/CoincidentNodes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kApartOfEdge = btScalar(0.1);

bool areEqual(const btVector3& a, const btVector3& b) { return a.x() == b.x() && a.y() == b.y() && a.z() == b.z(); }

}  // namespace

void CoincidentNodes::find(const std::vector<btVector3>& places) {
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&places](int a, int b) {
    const btVector3& p = places[toSize(a)];
    const btVector3& q = places[toSize(b)];
    return std::make_tuple(p.x(), p.y(), p.z(), a) < std::make_tuple(q.x(), q.y(), q.z(), b);
  });
  if (m_first.empty()) fitTo(places.size());
  const auto leastOf = [this](int node) {
    while (m_first[toSize(node)] != node) node = m_first[toSize(node)];
    return node;
  };
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (!areEqual(places[toSize(order[k])], places[toSize(order[k - 1])])) continue;
    const auto [less, more] = std::minmax({leastOf(order[k - 1]), leastOf(order[k])});
    m_first[toSize(more)] = less;
  }
  for (int& first : m_first) first = m_first[toSize(first)];
  findJoined();
  if (m_joined.empty()) m_first.clear();
}

void CoincidentNodes::keepOf(std::size_t nodeCount) {
  if (m_first.empty()) return;
  if (nodeCount < m_first.size()) m_first.clear();
  if (!m_first.empty()) fitTo(nodeCount);
  m_left.clear();
  findJoined();
}

// New nodes are their own.
void CoincidentNodes::fitTo(std::size_t nodeCount) {
  const std::size_t before = m_first.size();
  m_first.resize(nodeCount);
  std::iota(m_first.begin() + static_cast<std::ptrdiff_t>(before), m_first.end(), static_cast<int>(before));
}

void CoincidentNodes::setEdges(const std::vector<GuardMesh::Edge>& edges, const std::vector<btVector3>& places) {
  if (m_first.empty()) return;
  std::vector<bool> isOne(places.size());
  for (const int node : m_joined) isOne[toSize(node)] = isOne[toSize(first(node))] = true;
  m_apart.assign(places.size(), std::numeric_limits<btScalar>::max());
  m_around.assign(places.size(), {});
  for (const GuardMesh::Edge& edge : edges) {
    const auto [a, b] = edge.node;
    const btScalar length = (places[toSize(a)] - places[toSize(b)]).length();
    for (const auto& [node, neighbour] : {std::make_pair(a, b), std::make_pair(b, a)}) {
      if (!isOne[toSize(node)]) continue;
      m_apart[toSize(node)] = std::min(m_apart[toSize(node)], kApartOfEdge * length);
      m_around[toSize(node)].push_back(neighbour);
    }
  }
}

void CoincidentNodes::findJoined() {
  m_joined.clear();
  for (int node = 0; node < static_cast<int>(m_first.size()); ++node) {
    if (m_first[toSize(node)] != node) m_joined.push_back(node);
  }
  m_left.reserve(m_joined.size());
}

// Those that leave the same node have the first of them from now on.
void CoincidentNodes::endSeparating() {
  if (m_left.empty()) return;
  std::sort(m_left.begin(), m_left.end(),
            [](const Leaving& a, const Leaving& b) { return std::tie(a.other, a.node) < std::tie(b.other, b.node); });
  Leaving before = {-1, -1};
  for (const Leaving& leaving : m_left) {
    m_first[toSize(leaving.node)] = leaving.other == before.other ? first(before.node) : leaving.node;
    before = leaving;
  }
  findJoined();
}

bool CoincidentNodes::joinAgain(int a, int b) {
  const auto haveLeft = [=](const Leaving& leaving) {
    return (first(leaving.node) == first(a) && first(leaving.other) == first(b)) ||
           (first(leaving.node) == first(b) && first(leaving.other) == first(a));
  };
  const auto found = std::find_if(m_left.begin(), m_left.end(), haveLeft);
  if (found == m_left.end()) return false;
  const int one = first(found->other);
  const int left = first(found->node);
  for (int& node : m_first) node = node == left ? one : node;
  findJoined();
  return true;
}

void CoincidentNodes::transferState(StateArchive& archive, int nodeCount) {
  unsigned char areThere = m_first.empty() ? 0 : 1;
  archive.local(areThere);
  std::vector<int> first(areThere == 0 ? 0 : toSize(nodeCount));
  if (archive.isSaving()) first = m_first;
  int number = 0;  // none is one with a later one
  archive.each(first, [&archive, &number](int& node) {
    node = archive.place(node, ++number, "a node that stands where another does");
  });
  if (!archive.isRestoring()) return;
  m_first = first;
  m_left.clear();
  findJoined();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
