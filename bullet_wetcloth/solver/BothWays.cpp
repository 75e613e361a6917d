// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BothWays.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <map>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// A triangulation has up to 3 edges a node, and with one bending link across each edge up to 6. What has no more links
// than nodes is a rope.
bool hasOnlyEdges(const btSoftBody& body) {
  constexpr double kMostLinksPerNode = 3.5;
  const int links = body.m_links.size();
  const int nodes = body.m_nodes.size();
  return links > nodes && links < kMostLinksPerNode * nodes;
}

// Rest lengths of links by the numbers of their ends.
class RestLengths {
 public:
  explicit RestLengths(const btSoftBody& body) : m_body(body) {
    for (int k = 0; k < body.m_links.size(); ++k) {
      m_lengths[ends(body.m_links[k].m_n[0], body.m_links[k].m_n[1])] = body.m_links[k].m_rl;
    }
  }

  // Of an edge; 0: no link holds it.
  btScalar between(const btSoftBody::Node* a, const btSoftBody::Node* b) const {
    const auto found = m_lengths.find(ends(a, b));
    return found == m_lengths.end() ? 0 : found->second;
  }

 private:
  std::pair<int, int> ends(const btSoftBody::Node* a, const btSoftBody::Node* b) const {
    return std::minmax({nodeIndex(m_body, a), nodeIndex(m_body, b)});
  }

  const btSoftBody& m_body;
  std::map<std::pair<int, int>, btScalar> m_lengths;
};

// By the law of cosines, of the sides at rest: it does not matter how the cloth lies now.
bool isObtuse(const btSoftBody::Face& face, const RestLengths& lengths) {
  constexpr btScalar kCosineOf150Degrees = btScalar(-0.866);
  btScalar side[3];
  for (int k = 0; k < 3; ++k) {
    side[k] = lengths.between(face.m_n[k], face.m_n[(k + 1) % 3]);
    if (!(side[k] > 0)) return false;
  }
  std::sort(side, side + 3);
  const btScalar cosine = (side[0] * side[0] + side[1] * side[1] - side[2] * side[2]) / (2 * side[0] * side[1]);
  return cosine < kCosineOf150Degrees;
}

// A few, as in any irregular mesh, do no harm: up to a quarter of all was tried.
bool hasManyObtuseTriangles(const btSoftBody& body) {
  constexpr int kOneIn = 10;
  const RestLengths lengths(body);
  int count = 0;
  for (int k = 0; k < body.m_faces.size(); ++k) {
    if (isObtuse(body.m_faces[k], lengths)) ++count;
  }
  return kOneIn * count > body.m_faces.size();
}

}  // namespace

bool needsBothWays(const btSoftBody& body) { return hasOnlyEdges(body) || hasManyObtuseTriangles(body); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
