// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What of two parts of cloths is nearest to each other, and a direction that tells them apart.
///
/// The first part is a vertex and the second a face, or both are edges. Of the four nodes the first `first` are those
/// of the first part.
struct Separation {
  double normal[3];   ///< from the second part to the first, of length 1 but for rounding
  double weights[4];  ///< of the nodes: the place on the first part less that on the second is their sum
  double distance;    ///< between the two [m]; 0: they meet, and the normal says nothing
};

/// Of a vertex and a face.
Separation separationOfVertexAndFace(const double (&nodes)[4][3]);
/// Of two edges.
Separation separationOfEdges(const double (&nodes)[4][3]);

/// The same, where an end of one of them is what is nearest: of edges that are nearly parallel the other is not exact.
Separation separationOfEdgesAtAnEnd(const double (&nodes)[4][3]);

/// Turns the normal a little where the parts are not on the two sides of a plane across it, although they do not meet:
/// the direction between two places that are very near is not known to all its digits.
void turnApart(const double (&nodes)[4][3], int first, Separation& separation);

/// How far apart the two parts are along a direction, if they are on the two sides of a plane across it; else <= 0.
/// The rounding error is below 1e-15 times the largest distance between the nodes, for a direction of length 1.
/// @param low, high  get the node of each part that is nearest to the other along the direction
double gapAlong(const double (&normal)[3], const double (&nodes)[4][3], int first, int& low, int& high);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
