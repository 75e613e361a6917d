// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void GuardPlanes::clear() {
  for (std::vector<int>& nodes : m_node) nodes.clear();
  for (std::vector<int>& tiles : m_tile) tiles.clear();
  for (std::vector<btScalar>& axis : m_normal) axis.clear();
  for (std::vector<btScalar>& weights : m_weight) weights.clear();
  m_gap.clear();
  m_apart.clear();
}

void GuardPlanes::add(const Plane& plane) {
  for (std::size_t k = 0; k < 4; ++k) {
    m_node[k].push_back(plane.pair.node[k]);
    m_weight[k].push_back(plane.weights[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) m_normal[k].push_back(plane.normal[k]);
  for (std::size_t k = 0; k < 2; ++k) m_tile[k].push_back(plane.pair.tile[k]);
  m_gap.push_back(plane.gap);
  m_apart.push_back(plane.apart);
}

void GuardPlanes::pick(const std::vector<std::size_t>& kept) {
  const auto pickFrom = [&](auto& values) {
    for (std::size_t k = 0; k < kept.size(); ++k) values[k] = values[kept[k]];
    values.resize(kept.size());
  };
  for (std::vector<int>& nodes : m_node) pickFrom(nodes);
  for (std::vector<int>& tiles : m_tile) pickFrom(tiles);
  for (std::vector<btScalar>& axis : m_normal) pickFrom(axis);
  for (std::vector<btScalar>& weights : m_weight) pickFrom(weights);
  pickFrom(m_gap);
  pickFrom(m_apart);
}

GuardPlanes::Measure GuardPlanes::measure(std::size_t begin, const std::vector<GuardNodes::Place>& at) const {
  Measure result;
  if (begin + kAtOnce > size()) {
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      const Nearest one = nearest(std::min(begin + k, size() - 1), at);
      result.gap[k] = one.gap;
      result.apart[k] = one.apart;
    }
    return result;
  }
  Quad places[4][4];  // node, axis
  for (std::size_t node = 0; node < 4; ++node) {
    Quad rows[4];
    for (std::size_t k = 0; k < kAtOnce; ++k) rows[k] = load<Quad>(at[toSize(m_node[node][begin + k])].at);
    transpose(rows, places[node]);
  }
  const Quad x = load<Quad>(&m_normal[0][begin]);
  const Quad y = load<Quad>(&m_normal[1][begin]);
  const Quad z = load<Quad>(&m_normal[2][begin]);
  Quad along[4] = {everywhere<Quad>(0)};
  Quad apart = everywhere<Quad>(0);
  for (std::size_t node = 1; node < 4; ++node) {  // from the first: the weights' sum is 0
    along[node] = (places[node][0] - places[0][0]) * x + (places[node][1] - places[0][1]) * y +
                  (places[node][2] - places[0][2]) * z;
    apart = apart + along[node] * load<Quad>(&m_weight[node][begin]);
  }
  const Quad low = m_first == 1 ? along[0] : lesser(along[0], along[1]);
  const Quad high = m_first == 1 ? greater(greater(along[1], along[2]), along[3]) : greater(along[2], along[3]);
  store(result.gap, low - high);
  store(result.apart, apart);
  return result;
}

GuardPlanes::Nearest GuardPlanes::nearest(std::size_t plane, const std::vector<GuardNodes::Place>& at) const {
  btScalar along[4] = {0, 0, 0, 0};
  btScalar apart = 0;
  const GuardNodes::Place& origin = at[toSize(m_node[0][plane])];
  for (std::size_t node = 1; node < 4; ++node) {
    const GuardNodes::Place& place = at[toSize(m_node[node][plane])];
    along[node] = (place.at[0] - origin.at[0]) * m_normal[0][plane] +
                  (place.at[1] - origin.at[1]) * m_normal[1][plane] + (place.at[2] - origin.at[2]) * m_normal[2][plane];
    apart += along[node] * m_weight[node][plane];
  }
  const int low = m_first == 2 && along[1] < along[0] ? 1 : 0;
  int high = 3;
  for (int node = m_first; node < 3; ++node) high = along[node] > along[high] ? node : high;
  return {along[low] - along[high], apart, low, high};
}

void GuardPlanes::keep(std::size_t begin, const Measure& measure) {
  const std::size_t count = std::min(kAtOnce, size() - begin);
  std::copy(measure.gap, measure.gap + count, m_gap.begin() + static_cast<std::ptrdiff_t>(begin));
  std::copy(measure.apart, measure.apart + count, m_apart.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
