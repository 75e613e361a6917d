// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PackedLinks.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/GridLink.h"
#include "bullet_wetcloth/solver/Parts.h"
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

// Small against every length and inverse mass, and no division by it overflows.
constexpr btScalar kTiny = btScalar(1e-18);

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

// A link's pull: how far each end moves along the line between them, per inverse mass and length of that line.
template <class Lanes>
WETCLOTH_INLINE Lanes pull(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& inverseMass,
                           const Lanes& restLength, const Lanes& compliance, const Lanes& perStepSquared) {
  const Lanes tiny = everywhere<Lanes>(kTiny);
  const Lanes length = squareRoot(x * x + y * y + z * z) + tiny;
  const Lanes softened = everywhere<Lanes>(btScalar(0.5)) * inverseMass + compliance * perStepSquared;
  const Lanes stiff = choose(inverseMass > tiny, inverseMass, tiny);
  return (length - restLength) / (length * choose(softened > stiff, softened, stiff));
}

}  // namespace

void PackedLinks::reset(const btSoftBody& body, const NodeSlots& slots) {
  m_runs.clear();
  m_batches.clear();
  m_laneOfLink.assign(toSize(body.m_links.size()), 0);
  m_restLength.clear();
  const std::vector<int> others = addRuns(body, slots);
  m_inRuns = size() - others.size();
  m_firstBatchLane = m_restLength.size();
  addBatches(body, slots, others);
  m_compliance.assign(m_restLength.size(), kNoLink);
  m_corners.assign(m_batches.empty() ? 0 : slots.count, Corner());
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
  m_tileEnd.assign(slots.grid ? toSize(slots.grid->tiles()) : 0, 0);
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
        const btSoftBody::Link& link = body.m_links[colour[std::min(first + lane, end - 1)]];
        batch.a[lane] = slots.ofNode[toSize(nodeIndex(body, link.m_n[0]))];
        batch.b[lane] = slots.ofNode[toSize(nodeIndex(body, link.m_n[1]))];
        if (first + lane < end) m_laneOfLink[toSize(colour[first + lane])] = m_restLength.size() + lane;
      }
      m_batches.push_back(batch);
      m_restLength.resize(m_restLength.size() + kBatchLanes, 0);
    }
  }
}

struct PackedLinks::RunKernel {
  const PackedLinks& links;
  const LinkedNodes& nodes;
  btScalar perStepSquared;
  std::size_t first;  // run
  std::size_t end;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t k = first; k < end; ++k) run<Lanes>(links.m_runs[k]);
  }

  template <class Lanes>
  WETCLOTH_INLINE void run(const Run stretch) const {
    btScalar* const x = nodes.position[0];
    btScalar* const y = nodes.position[1];
    btScalar* const z = nodes.position[2];
    const btScalar* const inverseMass = nodes.inverseMass;
    const btScalar* const restLength = links.m_restLength.data() + stretch.firstLane;
    const btScalar* const compliance = links.m_compliance.data() + stretch.firstLane;
    const Lanes stepFactor = everywhere<Lanes>(perStepSquared);
    for (std::size_t k = 0; k < stretch.lanes; k += kLaneCount<Lanes>) {
      const std::size_t a = stretch.a + k;
      const std::size_t b = stretch.b + k;
      const Lanes ax = load<Lanes>(x + a), ay = load<Lanes>(y + a), az = load<Lanes>(z + a);
      const Lanes bx = load<Lanes>(x + b), by = load<Lanes>(y + b), bz = load<Lanes>(z + b);
      const Lanes wa = load<Lanes>(inverseMass + a);
      const Lanes wb = load<Lanes>(inverseMass + b);
      const Lanes dx = bx - ax, dy = by - ay, dz = bz - az;
      const Lanes share =
          pull<Lanes>(dx, dy, dz, wa + wb, load<Lanes>(restLength + k), load<Lanes>(compliance + k), stepFactor);
      const Lanes toA = share * wa;
      const Lanes toB = share * wb;
      store(x + a, ax + dx * toA);
      store(y + a, ay + dy * toA);
      store(z + a, az + dz * toA);
      store(x + b, bx - dx * toB);
      store(y + b, by - dy * toB);
      store(z + b, bz - dz * toB);
    }
  }
};

struct PackedLinks::BatchKernel {
  PackedLinks& links;
  btScalar perStepSquared;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const btScalar* restLength = links.m_restLength.data() + links.m_firstBatchLane;
    const btScalar* compliance = links.m_compliance.data() + links.m_firstBatchLane;
    for (const Batch& batch : links.m_batches) {
      run<Lanes>(batch, restLength, compliance);
      restLength += kBatchLanes;
      compliance += kBatchLanes;
    }
  }

  template <class Lanes>
  WETCLOTH_INLINE void run(const Batch& batch, const btScalar* restLength, const btScalar* compliance) const {
    const Lanes stepFactor = everywhere<Lanes>(perStepSquared);
    Corner* const corners = links.m_corners.data();
    btScalar d[4][kBatchLanes];  // from a to b; and the sum of their inverse masses
    btScalar share[kBatchLanes];
    for (std::size_t k = 0; k < kBatchLanes; ++k) {
      const Corner& a = corners[batch.a[k]];
      const Corner& b = corners[batch.b[k]];
      for (int axis = 0; axis < 3; ++axis) d[axis][k] = b.at[axis] - a.at[axis];
      d[3][k] = a.at[3] + b.at[3];
    }
    for (std::size_t k = 0; k < kBatchLanes; k += kLaneCount<Lanes>) {
      store(share + k,
            pull<Lanes>(load<Lanes>(d[0] + k), load<Lanes>(d[1] + k), load<Lanes>(d[2] + k), load<Lanes>(d[3] + k),
                        load<Lanes>(restLength + k), load<Lanes>(compliance + k), stepFactor));
    }
    for (std::size_t k = 0; k < kBatchLanes; ++k) {
      Corner& a = corners[batch.a[k]];
      Corner& b = corners[batch.b[k]];
      const btScalar toA = share[k] * a.at[3];
      const btScalar toB = share[k] * b.at[3];
      for (int axis = 0; axis < 3; ++axis) {
        a.at[axis] += d[axis][k] * toA;
        b.at[axis] -= d[axis][k] * toB;
      }
    }
  }
};

void PackedLinks::gather(const LinkedNodes& nodes) {
  for (std::size_t i = 0; i < m_corners.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) m_corners[i].at[axis] = nodes.position[axis][i];
    m_corners[i].at[3] = nodes.inverseMass[i];
  }
}

void PackedLinks::scatter(const LinkedNodes& nodes) const {
  for (std::size_t i = 0; i < m_corners.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][i] = m_corners[i].at[axis];
  }
}

void PackedLinks::solve(const LinkedNodes& nodes, btScalar h) {
  const btScalar perStepSquared = 1 / (h * h);
  forEachPart(m_tileEnd.size(), [&](std::size_t tile) {
    const std::size_t first = tile == 0 ? 0 : m_tileEnd[tile - 1];
    runOnBestLanes(RunKernel{*this, nodes, perStepSquared, first, m_tileEnd[tile]});
  });
  const std::size_t firstBetweenTiles = m_tileEnd.empty() ? 0 : m_tileEnd.back();
  runOnBestLanes(RunKernel{*this, nodes, perStepSquared, firstBetweenTiles, m_runs.size()});
  if (m_batches.empty()) return;
  gather(nodes);
  runOnBestLanes(BatchKernel{*this, perStepSquared});
  scatter(nodes);
}

void PackedLinks::transferState(StateArchive& archive) {
  archive.array(m_restLength);
  archive.array(m_compliance);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
