// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PackedLinks.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Quad.h"
#include "bullet_wetcloth/solver/BothWays.h"
#include "bullet_wetcloth/solver/GridLink.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr std::size_t kBatchLanes = NodeSlots::kLanes;
constexpr btScalar kNoLink = std::numeric_limits<btScalar>::infinity();

// Small against every inverse mass: what two pinned nodes resist with.
constexpr btScalar kLeastSoftness = btScalar(1e-18);
// A shorter link is one of this length [m].
constexpr btScalar kLeastLength = btScalar(1e-5);
constexpr btScalar kMostPerStepSquared = std::numeric_limits<btScalar>::max();

// Families of links in an order in which none sweeps along the cloth: first those of every other row, or column. Those
// that lead from one tile to the next come last.
struct Family {
  bool isBetweenTiles;
  int tile;
  int rows;
  int columns;
  int turn;   // of the class along the direction
  int other;  // class across it
  bool operator<(const Family& family) const {
    return std::tie(isBetweenTiles, tile, rows, columns, turn, other) <
           std::tie(family.isBetweenTiles, family.tile, family.rows, family.columns, family.turn, family.other);
  }
};

int turnOf(int position, int reach) {
  constexpr std::array<int, 4> alternating = {0, 2, 1, 3};
  return reach % 2 == 0 ? position : alternating[toSize(position)];
}

Family familyOf(const GridLink& link, int to, const NodeSlots::Grid& grid) {
  const int row = link.from / grid.columns % NodeSlots::kClasses;
  const int column = link.from % grid.columns % NodeSlots::kClasses;
  const int tile = grid.tileOf(link.from);
  const bool isBetweenTiles = tile != grid.tileOf(to);
  if (link.rows > 0) return {isBetweenTiles, tile, link.rows, link.columns, turnOf(row, link.rows), column};
  return {isBetweenTiles, tile, 0, link.columns, turnOf(column, link.columns), row};
}

// A link's pull: how far each end moves along the line between them, per inverse mass and length of that line. Its
// stretch over its length, 1 - 1 / sqrt(q) with q = length^2 / restLength^2, is the Pade approximant of it at q = 1,
// 4 / 5 (q^2 - 1) / ((q + 1)^2 - 4 / 5): to 6e-5 between 0.8 and 1.3 times the length, to 4e-2 up to three times, and
// no root and no division by a length of 0.
constexpr btScalar kPade = btScalar(0.8);
// Of q: its square is a number, and what it does is the same from far below on.
constexpr btScalar kMostStretchSquared = btScalar(1e15);

template <class Lanes>
WETCLOTH_INLINE Lanes pull(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& perRestSquared,
                           const Lanes& perStretch, const Lanes& unfelt) {
  const Lanes one = everywhere<Lanes>(1);
  const Lanes most = everywhere<Lanes>(kMostStretchSquared);
  const Lanes stretched = (x * x + y * y + z * z) * perRestSquared;
  const Lanes q = choose(stretched < most, stretched, most);
  const Lanes above = q + one;
  const Lanes off = (q - one) * above;
  const Lanes felt = choose(off * off > unfelt * perRestSquared, off, everywhere<Lanes>(0));
  return felt * perStretch / (above * above - everywhere<Lanes>(kPade));
}

// What the approximant is multiplied with: it over w + a, where w / 2 is taken off a.
template <class Lanes>
WETCLOTH_INLINE Lanes pullPerStretch(const Lanes& inverseMass, const Lanes& softness) {
  const Lanes softened = everywhere<Lanes>(btScalar(0.5)) * inverseMass + softness;
  return everywhere<Lanes>(kPade) / choose(softened > inverseMass, softened, inverseMass);
}

}  // namespace

void PackedLinks::reset(const btSoftBody& body, const NodeSlots& slots) {
  m_isBothWays = needsBothWays(body);
  m_runs.clear();
  m_batches.clear();
  m_laneOfLink.assign(toSize(body.m_links.size()), 0);
  m_restLength.clear();
  const std::vector<int> others = addRuns(body, slots);
  m_inRuns = size() - others.size();
  m_firstBatchLane = m_restLength.size();
  addBatches(body, slots, others);
  m_compliance.assign(m_restLength.size(), kNoLink);
  m_perRestSquared.assign(m_restLength.size(), 0);
  m_softness.assign(m_restLength.size(), kNoLink);
  m_perStretch.assign(m_restLength.size(), 0);
  m_h = 0;
  m_corners.assign(m_batches.empty() ? 0 : slots.count + 1, Corner());
  for (PackedNodes::Lane& end : m_inverseMass) end.assign(m_batches.size() * kBatchLanes, 0);
}

// Returns the links that are in none.
std::vector<int> PackedLinks::addRuns(const btSoftBody& body, const NodeSlots& slots) {
  std::map<Family, std::vector<int>> families;
  std::vector<int> others;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const int a = nodeIndex(body, body.m_links[k].m_n[0]);
    const int b = nodeIndex(body, body.m_links[k].m_n[1]);
    const auto found = slots.grid ? gridLink(a, b, slots.grid->columns) : std::nullopt;
    found ? families[familyOf(*found, std::max(a, b), *slots.grid)].push_back(k) : others.push_back(k);
  }
  m_tileEnd.assign(slots.tiles, 0);
  for (const auto& [family, links] : families) {
    const auto ends = [&](int k) {
      const btSoftBody::Link& link = body.m_links[k];
      const int first = std::min(nodeIndex(body, link.m_n[0]), nodeIndex(body, link.m_n[1]));
      const int second = std::max(nodeIndex(body, link.m_n[0]), nodeIndex(body, link.m_n[1]));
      return std::make_pair(toSize(slots.ofNode[toSize(first)]), toSize(slots.ofNode[toSize(second)]));
    };
    std::size_t first = std::numeric_limits<std::size_t>::max();
    std::size_t last = 0;
    for (const int k : links) {
      first = std::min(first, ends(k).first);
      last = std::max(last, ends(k).first);
    }
    first = first / kBatchLanes * kBatchLanes;
    const auto [a, b] = ends(links.front());
    const std::size_t lanes = (last - first) / kBatchLanes * kBatchLanes + kBatchLanes;
    m_runs.push_back({first, first + b - a, lanes, m_restLength.size()});
    std::vector<bool> isTaken(lanes);
    for (const int k : links) {
      const std::size_t lane = ends(k).first - first;
      if (isTaken[lane]) {
        others.push_back(k);  // two links between the same nodes
        continue;
      }
      isTaken[lane] = true;
      m_laneOfLink[toSize(k)] = m_restLength.size() + lane;
    }
    m_restLength.resize(m_restLength.size() + lanes, 0);
    if (!family.isBetweenTiles) m_tileEnd[toSize(family.tile)] = m_runs.size();
  }
  for (std::size_t tile = 1; tile < m_tileEnd.size(); ++tile)
    m_tileEnd[tile] = std::max(m_tileEnd[tile], m_tileEnd[tile - 1]);
  std::sort(others.begin(), others.end());
  return others;
}

// Each link goes to the first batch with room after all batches that have one of its nodes.
void PackedLinks::addBatches(const btSoftBody& body, const NodeSlots& slots, const std::vector<int>& links) {
  std::vector<std::size_t> firstFree(slots.count, 0);  // colour that a node may have next
  std::vector<std::vector<int>> colours;
  std::vector<std::vector<bool>> isUsed;
  for (const int k : links) {
    const std::size_t a = toSize(slots.ofNode[toSize(nodeIndex(body, body.m_links[k].m_n[0]))]);
    const std::size_t b = toSize(slots.ofNode[toSize(nodeIndex(body, body.m_links[k].m_n[1]))]);
    std::size_t colour = 0;
    while (colour < colours.size() && (isUsed[colour][a] || isUsed[colour][b])) ++colour;
    if (colour == colours.size()) {
      colours.emplace_back();
      isUsed.emplace_back(slots.count);
    }
    colours[colour].push_back(k);
    isUsed[colour][a] = isUsed[colour][b] = true;
  }
  for (const std::vector<int>& colour : colours) {
    for (std::size_t first = 0; first < colour.size(); first += kBatchLanes) {
      Batch batch = {};
      const std::size_t end = std::min(colour.size(), first + kBatchLanes);
      for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
        batch.a[lane] = batch.b[lane] = static_cast<int>(slots.count);  // where no node is
        if (first + lane >= end) continue;
        const btSoftBody::Link& link = body.m_links[colour[first + lane]];
        batch.a[lane] = slots.ofNode[toSize(nodeIndex(body, link.m_n[0]))];
        batch.b[lane] = slots.ofNode[toSize(nodeIndex(body, link.m_n[1]))];
        m_laneOfLink[toSize(colour[first + lane])] = m_restLength.size() + lane;
      }
      m_batches.push_back(batch);
      m_restLength.resize(m_restLength.size() + kBatchLanes, 0);
    }
  }
}

struct PackedLinks::RunKernel {
  const PackedLinks& links;
  const LinkedNodes& nodes;
  std::size_t first;  // run
  std::size_t end;
  bool isBack;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    if (isBack) {
      for (std::size_t k = end; k > first; --k) run<Lanes>(links.m_runs[k - 1]);
    } else {
      for (std::size_t k = first; k < end; ++k) run<Lanes>(links.m_runs[k]);
    }
  }

  template <class Lanes>
  WETCLOTH_INLINE void run(const Run stretch) const {
    btScalar* const xa = nodes.position[0] + stretch.a;
    btScalar* const ya = nodes.position[1] + stretch.a;
    btScalar* const za = nodes.position[2] + stretch.a;
    btScalar* const xb = nodes.position[0] + stretch.b;
    btScalar* const yb = nodes.position[1] + stretch.b;
    btScalar* const zb = nodes.position[2] + stretch.b;
    const btScalar* const inverseMassOfA = nodes.inverseMass + stretch.a;
    const btScalar* const inverseMassOfB = nodes.inverseMass + stretch.b;
    const btScalar* const perRestSquared = links.m_perRestSquared.data() + stretch.firstLane;
    const btScalar* const perStretch = links.m_perStretch.data() + stretch.firstLane;
    const std::size_t lanes = stretch.lanes;
    const Lanes unfelt = everywhere<Lanes>(links.m_unfelt);
    for (std::size_t k = 0; k < lanes; k += kLaneCount<Lanes>) {
      const Lanes ax = load<Lanes>(xa + k), ay = load<Lanes>(ya + k), az = load<Lanes>(za + k);
      const Lanes bx = load<Lanes>(xb + k), by = load<Lanes>(yb + k), bz = load<Lanes>(zb + k);
      const Lanes wa = load<Lanes>(inverseMassOfA + k);
      const Lanes wb = load<Lanes>(inverseMassOfB + k);
      const Lanes dx = bx - ax, dy = by - ay, dz = bz - az;
      const Lanes share = pull<Lanes>(dx, dy, dz, load<Lanes>(perRestSquared + k), load<Lanes>(perStretch + k), unfelt);
      const Lanes toA = share * wa;
      const Lanes toB = share * wb;
      store(xa + k, ax + dx * toA);
      store(ya + k, ay + dy * toA);
      store(za + k, az + dz * toA);
      store(xb + k, bx - dx * toB);
      store(yb + k, by - dy * toB);
      store(zb + k, bz - dz * toB);
    }
  }
};

// What links resist with, by the masses that their nodes have now.
struct PackedLinks::MassKernel {
  PackedLinks& links;
  const LinkedNodes& nodes;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (const Run& stretch : links.m_runs) {
      run<Lanes>(nodes.inverseMass + stretch.a, nodes.inverseMass + stretch.b, stretch.firstLane, stretch.lanes);
    }
    const std::size_t inBatches = links.m_batches.size() * kBatchLanes;
    run<Lanes>(links.m_inverseMass[0].data(), links.m_inverseMass[1].data(), links.m_firstBatchLane, inBatches);
  }

  template <class Lanes>
  WETCLOTH_INLINE void run(const btScalar* wa, const btScalar* wb, std::size_t firstLane, std::size_t lanes) const {
    const btScalar* const softness = links.m_softness.data() + firstLane;
    btScalar* const perStretch = links.m_perStretch.data() + firstLane;
    for (std::size_t k = 0; k < lanes; k += kLaneCount<Lanes>) {
      const Lanes inverseMass = load<Lanes>(wa + k) + load<Lanes>(wb + k);
      store(perStretch + k, pullPerStretch<Lanes>(inverseMass, load<Lanes>(softness + k)));
    }
  }
};

// Four links at once: their nodes are read and written one by one, each as a whole.
struct PackedLinks::BatchKernel {
  PackedLinks& links;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const std::size_t count = links.m_batches.size();
    for (std::size_t k = 0; k < count; ++k) runBatch(k);
    if (!links.m_isBothWays) return;
    for (std::size_t k = count; k > 0; --k) runBatch(k - 1);
  }

  WETCLOTH_INLINE void runBatch(std::size_t index) const {
    const Batch& batch = links.m_batches[index];
    const std::size_t lane = links.m_firstBatchLane + index * kBatchLanes;
    for (std::size_t k = 0; k < kBatchLanes; k += 4) run(batch.a + k, batch.b + k, lane + k);
  }

  WETCLOTH_INLINE void run(const int* a, const int* b, std::size_t lane) const {
    Corner* const corners = links.m_corners.data();
    const std::size_t inBatches = lane - links.m_firstBatchLane;
    Quad atA[4];
    Quad atB[4];
    Quad way[4];
    for (int k = 0; k < 4; ++k) {
      atA[k] = load<Quad>(corners[a[k]].at);
      atB[k] = load<Quad>(corners[b[k]].at);
      way[k] = atB[k] - atA[k];
    }
    Quad axes[4];
    transpose(way, axes);
    const Quad wa = load<Quad>(links.m_inverseMass[0].data() + inBatches);
    const Quad wb = load<Quad>(links.m_inverseMass[1].data() + inBatches);
    const Quad share = pull(axes[0], axes[1], axes[2], load<Quad>(links.m_perRestSquared.data() + lane),
                            load<Quad>(links.m_perStretch.data() + lane), everywhere<Quad>(links.m_unfelt));
    const Quad toA = share * wa;
    const Quad toB = share * wb;
    const Quad sharesOfA[4] = {splat<0>(toA), splat<1>(toA), splat<2>(toA), splat<3>(toA)};
    const Quad sharesOfB[4] = {splat<0>(toB), splat<1>(toB), splat<2>(toB), splat<3>(toB)};
    for (int k = 0; k < 4; ++k) {
      store(corners[a[k]].at, atA[k] + way[k] * sharesOfA[k]);
      store(corners[b[k]].at, atB[k] - way[k] * sharesOfB[k]);
    }
  }
};

void PackedLinks::gather(const LinkedNodes& nodes) {
  for (std::size_t i = 0; i + 1 < m_corners.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) m_corners[i].at[axis] = nodes.position[axis][i];
  }
}

void PackedLinks::scatter(const LinkedNodes& nodes) const {
  for (std::size_t i = 0; i + 1 < m_corners.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][i] = m_corners[i].at[axis];
  }
}

void PackedLinks::prepare(const LinkedNodes& nodes, btScalar h, btScalar rounding) {
  constexpr btScalar kPerStretch = 4;  // of q^2 - 1, for a small one
  m_unfelt = (kPerStretch * rounding) * (kPerStretch * rounding);
  if (h != m_h) prepareLength(h);
  for (std::size_t k = 0; k < m_batches.size(); ++k) {
    for (std::size_t lane = 0; lane < kBatchLanes; ++lane) {
      m_inverseMass[0][k * kBatchLanes + lane] = nodes.inverseMass[m_batches[k].a[lane]];
      m_inverseMass[1][k * kBatchLanes + lane] = nodes.inverseMass[m_batches[k].b[lane]];
    }
  }
  runOnBestLanes(MassKernel{*this, nodes});
}

void PackedLinks::prepareLength(btScalar h) {
  m_h = h;
  const btScalar perStepSquared = std::min(static_cast<btScalar>(passes()) / (h * h), kMostPerStepSquared);
  for (std::size_t k = 0; k < m_restLength.size(); ++k) {
    const btScalar length = std::max(m_restLength[k], kLeastLength);
    m_perRestSquared[k] = m_compliance[k] == kNoLink ? 0 : 1 / (length * length);
    m_softness[k] = std::max(m_compliance[k] * perStepSquared, kLeastSoftness);
  }
}

void PackedLinks::solveTile(const LinkedNodes& nodes, std::size_t tile) {
  solveRuns(nodes, tile == 0 ? 0 : m_tileEnd[tile - 1], m_tileEnd[tile], false);
}

void PackedLinks::solveOthers(const LinkedNodes& nodes) {
  solveRuns(nodes, m_tileEnd.back(), m_runs.size(), false);
  if (!m_batches.empty()) {
    gather(nodes);
    runOnBestLanes(BatchKernel{*this});
    scatter(nodes);
  }
  if (m_isBothWays) solveRuns(nodes, m_tileEnd.back(), m_runs.size(), true);
}

void PackedLinks::solveTileBack(const LinkedNodes& nodes, std::size_t tile) {
  solveRuns(nodes, tile == 0 ? 0 : m_tileEnd[tile - 1], m_tileEnd[tile], true);
}

void PackedLinks::solveRuns(const LinkedNodes& nodes, std::size_t first, std::size_t end, bool isBack) {
  runOnBestLanes(RunKernel{*this, nodes, first, end, isBack});
}

void PackedLinks::transferState(StateArchive& archive) {
  archive.array(m_restLength);
  archive.array(m_compliance);
  archive.value(m_isBothWays);
  if (archive.isRestoring()) m_h = 0;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
