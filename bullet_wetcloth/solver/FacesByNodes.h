// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Finds a face of a body by its three nodes.
class FacesByNodes {
 public:
  explicit FacesByNodes(const btSoftBody& body);

  /// The number of the face that has these nodes, in any order; of several the first; -1: none has.
  int find(int a, int b, int c) const;

 private:
  struct Face {
    int others[2];  // its nodes but the least, in rising order
    int number;
  };
  std::vector<int> m_first;  // of each node: the first of the faces of which it is the least node
  std::vector<Face> m_faces;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
