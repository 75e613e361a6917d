// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/Quad.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A Separation of four pairs at once, in the precision of the places.
///
/// The gap along a direction is at most the distance of two parts, and this at most the way between any two of their
/// places. So a gap that is nearly as long as the way says by itself that both are good; where it is not, Separation
/// has to be asked.
struct QuadSeparation {
  Quad normal[3];   ///< from the second part to the first, of length 1 but for rounding
  Quad weights[4];  ///< of the nodes: the place on the first part less that on the second is their sum
  Quad distance;    ///< between the two [m]
  Quad gap;         ///< along the normal, as gapAlong() [m]
  unsigned isGood;  ///< bit k: of pair k the gap is nearly the distance; never where anything is not a number
};

/// Four places of each of the four nodes: node, axis. Those of the last axis mean nothing.
using QuadPlaces = Quad[4][4];

/// @tparam first  how many nodes are of the first part: a vertex (1) and a face, or two edges (2)
template <int first>
QuadSeparation separationOf(const QuadPlaces& nodes);

/// How far apart the parts are along a direction, if they are on the two sides of a plane across it; else <= 0.
template <int first>
Quad gapAlong(const Quad (&normal)[3], const QuadPlaces& nodes);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
