// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/TurnedPlane.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/Separation.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using CornerPlaces = double[4][3];

// Where the nodes are, this share of the way from where they were to where they are.
void placesAt(double share, const GuardPair& pair, const GuardNodes& nodes, CornerPlaces& places) {
  for (int node = 0; node < 4; ++node) {
    const std::size_t i = toSize(pair.node[node]);
    for (int k = 0; k < 3; ++k) {
      const double from = static_cast<double>(nodes.from[i].at[k]);
      const double to = static_cast<double>(nodes.to[i].at[k]);
      places[node][k] = share < 1 ? from + share * (to - from) : to;
    }
  }
}

}  // namespace

std::optional<GuardPlanes::Plane> turnedPlane(const GuardPair& pair, const GuardNodes& nodes, int first, double least) {
  CornerPlaces from, to;
  placesAt(0, pair, nodes, from);
  placesAt(1, pair, nodes, to);
  GuardPlanes::Plane best = {pair, {}, {}, 0, 0};
  double most = least;
  for (const double share : {1.0, 0.5}) {
    CornerPlaces places;
    placesAt(share, pair, nodes, places);
    Separation separation = first == 1 ? separationOfVertexAndFace(places) : separationOfEdges(places);
    turnApart(places, first, separation);
    double normal[3];
    for (int k = 0; k < 3; ++k) normal[k] = static_cast<double>(static_cast<btScalar>(separation.normal[k]));
    int low = 0, high = 0;
    const double gapThen = gapAlong(normal, to, first, low, high);
    const double gap = gapAlong(normal, from, first, low, high);
    if (!(std::min(gap, gapThen) > most)) continue;
    most = std::min(gap, gapThen);
    best.gap = static_cast<btScalar>(gap);
    double apart = 0;
    for (int k = 0; k < 3; ++k) {
      best.normal[k] = static_cast<btScalar>(normal[k]);
      for (int node = 0; node < 4; ++node) apart += separation.weights[node] * normal[k] * (from[node][k] - from[0][k]);
    }
    for (int node = 0; node < 4; ++node) best.weights[node] = static_cast<btScalar>(separation.weights[node]);
    best.apart = static_cast<btScalar>(apart);
  }
  return most > least ? std::optional<GuardPlanes::Plane>(best) : std::nullopt;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
