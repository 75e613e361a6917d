// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Places of four nodes, or of eight.
template <class Lanes>
WETCLOTH_INLINE Lanes loadPlaces(const GuardNodes::Place* at, const int* nodes) {
  if constexpr (kLaneCount<Lanes> == 8) {
    return sideBySide<Lanes>(load<Quad>(at[nodes[0]].at), load<Quad>(at[nodes[4]].at));
  } else {
    return load<Quad>(at[nodes[0]].at);
  }
}

// By axis.
template <class Lanes>
WETCLOTH_INLINE void gatherPlaces(const GuardNodes::Place* at, const int* nodes, Lanes (&axes)[4]) {
  const Lanes rows[4] = {loadPlaces<Lanes>(at, nodes), loadPlaces<Lanes>(at, nodes + 1),
                         loadPlaces<Lanes>(at, nodes + 2), loadPlaces<Lanes>(at, nodes + 3)};
  transpose(rows, axes);
}

}  // namespace

void GuardPlanes::clear() {
  m_size = 0;
  m_blocks.clear();
  m_tiles.clear();
  m_kept.clear();
  m_measured.clear();
}

void GuardPlanes::add(const Plane& plane) {
  const std::size_t k = m_size++ % kAtOnce;
  if (k == 0) {
    m_blocks.emplace_back();
    m_kept.emplace_back();
    m_measured.emplace_back();
    std::fill_n(m_kept.back().gap, kAtOnce, std::numeric_limits<btScalar>::infinity());
    std::fill_n(m_kept.back().apart, kAtOnce, std::numeric_limits<btScalar>::infinity());
  }
  m_tiles.push_back({});
  set(m_size - 1, plane);
}

void GuardPlanes::set(std::size_t index, const Plane& plane) {
  const std::size_t k = index % kAtOnce;
  Block& block = m_blocks[index / kAtOnce];
  Measure& kept = m_kept[index / kAtOnce];
  m_tiles[index] = {{plane.pair.tile[0], plane.pair.tile[1]}};
  for (std::size_t which = 0; which < 4; ++which) {
    block.node[which][k] = plane.pair.node[which];
    block.weight[which][k] = plane.weights[which];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) block.normal[axis][k] = plane.normal[axis];
  kept.gap[k] = plane.gap;
  kept.apart[k] = plane.apart;
}

void GuardPlanes::copy(std::size_t from, std::size_t to) {
  const Block& source = m_blocks[from / kAtOnce];
  Block& block = m_blocks[to / kAtOnce];
  const std::size_t i = from % kAtOnce;
  const std::size_t k = to % kAtOnce;
  for (int which = 0; which < 4; ++which) {
    block.node[which][k] = source.node[which][i];
    block.weight[which][k] = source.weight[which][i];
  }
  for (int axis = 0; axis < 3; ++axis) block.normal[axis][k] = source.normal[axis][i];
  m_tiles[to] = m_tiles[from];
  m_kept[to / kAtOnce].gap[k] = m_kept[from / kAtOnce].gap[i];
  m_kept[to / kAtOnce].apart[k] = m_kept[from / kAtOnce].apart[i];
}

void GuardPlanes::truncate(std::size_t size) {
  const std::size_t blocks = (size + kAtOnce - 1) / kAtOnce;
  m_size = size;
  m_tiles.resize(size);
  m_blocks.resize(blocks);
  m_kept.resize(blocks);
  m_measured.resize(blocks);
  for (std::size_t plane = size; plane < blocks * kAtOnce; ++plane) {
    m_kept.back().gap[plane % kAtOnce] = m_kept.back().apart[plane % kAtOnce] =
        std::numeric_limits<btScalar>::infinity();
  }
}

// Measures the planes of a block.
struct GuardPlanes::Gauge {
  const Block& block;
  const GuardNodes::Place* at;
  int first;
  Measure& result;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    using Several = std::conditional_t<kLaneCount<Lanes> == kAtOnce, Lanes, Quad>;
    for (std::size_t k = 0; k < kAtOnce; k += kLaneCount<Several>) measure<Several>(k);
  }

 private:
  template <class Lanes>
  WETCLOTH_INLINE void measure(std::size_t begin) const {
    Lanes origin[4];
    gatherPlaces(at, block.node[0] + begin, origin);
    const Lanes second = along<Lanes>(1, origin, begin);
    const Lanes third = along<Lanes>(2, origin, begin);
    const Lanes fourth = along<Lanes>(3, origin, begin);
    const Lanes zero = everywhere<Lanes>(0);
    const Lanes apart = second * load<Lanes>(block.weight[1] + begin) + third * load<Lanes>(block.weight[2] + begin) +
                        fourth * load<Lanes>(block.weight[3] + begin);  // the weights' sum is 0
    const Lanes low = first == 1 ? zero : lesser(zero, second);
    const Lanes high = first == 1 ? greater(greater(second, third), fourth) : greater(third, fourth);
    store(result.gap + begin, low - high);
    store(result.apart + begin, apart);
  }

  // How far a node is from the first along the normal.
  template <class Lanes>
  WETCLOTH_INLINE Lanes along(int node, const Lanes (&origin)[4], std::size_t begin) const {
    Lanes place[4];
    gatherPlaces(at, block.node[node] + begin, place);
    return (place[0] - origin[0]) * load<Lanes>(block.normal[0] + begin) +
           (place[1] - origin[1]) * load<Lanes>(block.normal[1] + begin) +
           (place[2] - origin[2]) * load<Lanes>(block.normal[2] + begin);
  }
};

const GuardPlanes::Measure& GuardPlanes::measure(std::size_t block, const std::vector<GuardNodes::Place>& at) {
  Measure& result = m_measured[block];
  runOnBestLanes(Gauge{m_blocks[block], at.data(), m_first, result});
  for (std::size_t k = m_size - block * kAtOnce; k < kAtOnce; ++k) {
    result.gap[k] = result.apart[k] = std::numeric_limits<btScalar>::infinity();
  }
  return result;
}

GuardPlanes::Nearest GuardPlanes::nearest(std::size_t plane, const std::vector<GuardNodes::Place>& at) const {
  const Block& block = blockOf(plane);
  const std::size_t k = plane % kAtOnce;
  btScalar along[4] = {0, 0, 0, 0};
  btScalar apart = 0;
  const GuardNodes::Place& origin = at[toSize(block.node[0][k])];
  for (std::size_t node = 1; node < 4; ++node) {
    const GuardNodes::Place& place = at[toSize(block.node[node][k])];
    along[node] = (place.at[0] - origin.at[0]) * block.normal[0][k] +
                  (place.at[1] - origin.at[1]) * block.normal[1][k] + (place.at[2] - origin.at[2]) * block.normal[2][k];
    apart += along[node] * block.weight[node][k];
  }
  const int low = m_first == 2 && along[1] < along[0] ? 1 : 0;
  int high = 3;
  for (int node = m_first; node < 3; ++node) high = along[node] > along[high] ? node : high;
  return {along[low] - along[high], apart, low, high};
}

void GuardPlanes::keep() { m_kept.swap(m_measured); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
