// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/RestMesh.h"

#include <array>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A triangle known by the lengths of its sides alone; lengths[k] is of the side opposite nodes[k].
struct MeasuredTriangle {
  std::array<int, 3> nodes;
  std::array<double, 3> lengths;
};

/// A pair of nodes, once, a < b.
struct WeightedEdge {
  int a;
  int b;
  double weight;
};

/// The triangles of a cloth at rest, each layer once.
std::vector<MeasuredTriangle> measuredTriangles(const RestMesh& mesh);

/// The same in the metric of an orthotropic diffusivity, in which diffusion is isotropic: a side along the warp is
/// |side| / sqrt(warpDiffusivity) long, one along the weft |side| / sqrt(weftDiffusivity). The weights of these
/// triangles times sqrt(warpDiffusivity weftDiffusivity) are those of div(D grad).
/// @param warpCoordinate  of each node; its gradient over a triangle is the warp there. A triangle on which it does not
///                        change has no warp, and is isotropic with the geometric mean.
/// @param warpDiffusivity, weftDiffusivity  > 0
std::vector<MeasuredTriangle> orthotropicTriangles(const RestMesh& mesh, const std::vector<double>& warpCoordinate,
                                                   double warpDiffusivity, double weftDiffusivity);

/// Weights w_ij >= 0 of the Laplacian (L u)_i = sum_j w_ij (u_i - u_j) of a triangulated surface: (cot a + cot b) / 2
/// of the two angles opposite an edge (Pinkall & Polthier 1993), after edges were flipped within the surface until it
/// is Delaunay (Bobenko & Springborn 2007, "A discrete Laplace-Beltrami operator for simplicial surfaces"). So obtuse
/// triangles neither spoil the maximum principle nor the consistency.
///
/// What no flip can mend counts as 0: the side of an obtuse triangle at the border or where more than two triangles
/// meet. A triangle of no area, of sides that do not make one, or with a node twice conducts nothing. Sorted by (a, b);
/// pairs of weight 0 are left out. Finite for any input; O(n log n) for meshes that occur.
std::vector<WeightedEdge> delaunayWeights(const std::vector<MeasuredTriangle>& triangles);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
