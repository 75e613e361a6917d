// SPDX-License-Identifier: Zlib
#pragma once

namespace wetcloth::collision {

/// What may meet in one query.
enum class Pair {
  vertexFace,  ///< point 0 against the triangle 1, 2, 3
  edgeEdge     ///< the edge 0-1 against the edge 2-3
};

/// Four points that move on straight lines at constant speed: point i is at start[i] at time 0 and at end[i] at
/// time 1, in any unit of length. Triangles and edges include their boundaries and may be degenerate.
template <class Scalar>
struct Query {
  Scalar start[4][3];  ///< x, y, z of each point at time 0
  Scalar end[4][3];    ///< and at time 1
};

/// The answer to a query.
struct Contact {
  bool found = false;  ///< whether the two meet
  /// When the two first meet, in [0, 1], from below: never later than the true time. 0 when nothing was found.
  double time = 0;
  /// Where, at `time`. vertexFace: the weights of points 2 and 3 (point 1 has the rest), each in [0, 1] and no more
  /// than 1 in sum. edgeEdge: the parameters along 0-1 and 2-3, each in [0, 1]. The nearest point of the face, or the
  /// nearest points of the edges, where `time` is earlier than the true one.
  double where[2] = {0, 0};
  /// The same as `found`.
  explicit operator bool() const { return found; }
};

}  // namespace wetcloth::collision
