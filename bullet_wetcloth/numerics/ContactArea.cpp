// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/ContactArea.h"

#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/water/Water.h"

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double contactArea(const RestMesh& mesh, const Water& water, double arealDensity, std::size_t node) {
  const std::vector<double>& areas = mesh.nodeAreas();
  const double area = node < areas.size() ? areas[node] : 0;
  return area > 0 ? area : water.dryMass(node) / arealDensity;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
