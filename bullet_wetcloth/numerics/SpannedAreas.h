// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>
#include <LinearMath/btVector3.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class RestMesh;

/// The area that the triangles of a node span together, |sum of A_t n_t|, as a share of their area at rest. It shrinks
/// where cloth is pressed together in its plane, and where it crumples: links keep their lengths then, and so do
/// triangles their areas, but the nodes round the node come nearer. Of a flat cloth of its size at rest it is 1, along
/// a crease by an angle phi across the node cos(phi / 2). Crumples smaller than the triangles are not seen.
class WETCLOTH_EXPORT SpannedAreas {
 public:
  /// The body's nodes or faces changed.
  void restart() { m_windings.clear(); }

  /// Of the body as it is now; `mesh` is its own. Allocates in the first call after restart().
  void measure(const RestMesh& mesh, const btSoftBody& body);

  /// Of a node, as last measured, [0, 1]: 1 where cloth is stretched, has no triangles or is not finite, and
  /// where less than 1e-5 is missing, by which lengths are rounded.
  double share(std::size_t node) const { return m_shares[node]; }

 private:
  void fit(const RestMesh& mesh);

  std::vector<int> m_windings;     // of the triangles; empty until the first measurement
  std::vector<btVector3> m_spans;  // of the nodes: twice their triangles' areas along the normals [m^2]
  std::vector<double> m_shares;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
