// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/DryMass.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Layers.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Bullet rounds the masses that it shares out; less than this is not a change.
constexpr double kMassRounding = 1e-5;

double inverseMassOf(const btSoftBody& body, std::size_t node) {
  return static_cast<double>(body.m_nodes[static_cast<int>(node)].m_im);
}

void requireMasses(const btSoftBody& body) {
  if (body.m_nodes.size() == 0) rejectValue("body.m_nodes.size()", 0, "at least 1");
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    requireNotNegative("body.m_nodes[" + std::to_string(i) + "].m_im", static_cast<double>(body.m_nodes[i].m_im));
  }
}

// The free nodes of one fabric.
struct FreeNodes {
  double mass = 0;
  double area = 0;
  int count = 0;
};

// What a pinned node weighs: by the free nodes' density where there are faces, by their mean elsewhere.
std::vector<double> pinnedMasses(const btSoftBody& body, const std::vector<double>& areas,
                                 const std::vector<double>& arealDensities, const std::vector<int>& fabricOfNode) {
  std::vector<FreeNodes> free(arealDensities.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    if (!(inverseMassOf(body, i) > 0)) continue;
    FreeNodes& alike = free[toSize(fabricOfNode[i])];
    alike.mass += 1 / inverseMassOf(body, i);
    alike.area += areas[i];
    ++alike.count;
  }
  std::vector<double> masses(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const FreeNodes& alike = free[toSize(fabricOfNode[i])];
    const double density = alike.area > 0 ? alike.mass / alike.area : arealDensities[toSize(fabricOfNode[i])];
    masses[i] = areas[i] > 0 || alike.count == 0 ? density * areas[i] : alike.mass / alike.count;
    if (!(masses[i] > 0) && !(inverseMassOf(body, i) > 0)) {
      rejectValue("body.m_nodes[" + std::to_string(i) + "].m_im", 0,
                  "> 0, or the node part of a face: nothing tells what this pinned node weighs");
    }
  }
  return masses;
}

bool hasPinnedNodes(const btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (!(body.m_nodes[i].m_im > 0)) return true;
  }
  return false;
}

// Calls visit(new node, old node) for each link between two such, after a cut.
template <class Visit>
void forEachLinkToOld(const btSoftBody& body, std::size_t oldCount, const Visit& visit) {
  for (int k = 0; k < body.m_links.size(); ++k) {
    const std::size_t ends[2] = {toSize(nodeIndex(body, body.m_links[k].m_n[0])),
                                 toSize(nodeIndex(body, body.m_links[k].m_n[1]))};
    for (int side = 0; side < 2; ++side) {
      const std::size_t added = ends[side];
      const std::size_t old = ends[1 - side];
      if (added < oldCount || old >= oldCount) continue;
      visit(added, old);
    }
  }
}

// Water per wet mass around each new node: the mean over the old nodes that it is linked to, or `elsewhere`.
std::vector<double> neighbourWaterShare(const btSoftBody& body, const Water& water, std::size_t newCount,
                                        double elsewhere) {
  const std::size_t oldCount = water.size();
  std::vector<double> share(newCount, 0);
  std::vector<int> count(newCount, 0);
  forEachLinkToOld(body, oldCount, [&](std::size_t added, std::size_t old) {
    share[added - oldCount] += water.held(old) / water.totalMass(old);
    ++count[added - oldCount];
  });
  for (std::size_t i = 0; i < newCount; ++i) share[i] = count[i] > 0 ? share[i] / count[i] : elsewhere;
  return share;
}

btScalar distance2(const btSoftBody& body, std::size_t a, std::size_t b) {
  return (body.m_nodes[static_cast<int>(a)].m_x - body.m_nodes[static_cast<int>(b)].m_x).length2();
}

std::size_t nearestOldNode(const btSoftBody& body, std::size_t oldCount, std::size_t added) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < oldCount; ++i) {
    if (distance2(body, i, added) < distance2(body, nearest, added)) nearest = i;
  }
  return nearest;
}

// Of each node: an old one keeps its own, a new one takes that of the nearest old node that it is linked to; one
// without such a link, as Bullet leaves some, that of the nearest of all.
std::vector<int> fabricsAfterCut(const btSoftBody& body, const Water& water) {
  std::vector<int> fabrics(static_cast<std::size_t>(body.m_nodes.size()), 0);
  if (water.fabricCount() == 1) return fabrics;
  const std::size_t oldCount = std::min(water.size(), fabrics.size());
  std::vector<std::size_t> origin(fabrics.size(), oldCount);
  for (std::size_t i = 0; i < oldCount; ++i) origin[i] = i;
  forEachLinkToOld(body, oldCount, [&](std::size_t added, std::size_t old) {
    const bool isFirst = origin[added] == oldCount;
    if (isFirst || distance2(body, old, added) < distance2(body, origin[added], added)) origin[added] = old;
  });
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    const std::size_t from = origin[i] < oldCount ? origin[i] : nearestOldNode(body, oldCount, i);
    fabrics[i] = static_cast<int>(water.fabric(from));
  }
  return fabrics;
}

// Of what saturated cloth weighs, how much is water.
double waterShare(double capacityRatio) { return capacityRatio / (1 + capacityRatio); }

double largestCapacityRatio(const Water& water) {
  double largest = 0;
  for (std::size_t k = 0; k < water.fabricCount(); ++k) largest = std::max(largest, water.capacityRatio(k));
  return largest;
}

// Shares `amount` out in proportion to the weights, as far as there is room, and the rest by the room that is left;
// what is more than all the room, in proportion to it.
std::vector<double> shareOut(double amount, const std::vector<double>& weights, const std::vector<double>& rooms) {
  std::vector<double> parts(weights.size(), 0);
  const double total = compensatedSum(weights);
  if (total > 0) {
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] = std::min(amount * weights[k] / total, rooms[k]);
  }
  const double rest = amount - compensatedSum(parts);
  const double room = compensatedSum(rooms) - compensatedSum(parts);
  if (!(rest > 0)) return parts;
  if (rest <= room) {
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] += rest * ((rooms[k] - parts[k]) / room);
  } else {
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] = amount * (rooms[k] / compensatedSum(rooms));
  }
  return parts;
}

}  // namespace

std::vector<double> nodeAreas(const btSoftBody& body) {
  std::vector<double> areas(static_cast<std::size_t>(body.m_nodes.size()), 0);
  for (const FaceNodes& corners : layersOf(body)) {
    const btVector3& origin = body.m_nodes[corners[0]].m_x;
    const btVector3 twice = (body.m_nodes[corners[1]].m_x - origin).cross(body.m_nodes[corners[2]].m_x - origin);
    for (const int corner : corners) areas[toSize(corner)] += static_cast<double>(twice.length()) / 6;
  }
  return areas;
}

std::vector<double> dryMasses(const btSoftBody& body, const std::vector<double>& arealDensities,
                              const std::vector<int>& fabricOfNode) {
  requireMasses(body);
  std::vector<double> masses(static_cast<std::size_t>(body.m_nodes.size()));
  if (hasPinnedNodes(body)) masses = pinnedMasses(body, nodeAreas(body), arealDensities, fabricOfNode);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (inverseMassOf(body, i) > 0) masses[i] = 1 / inverseMassOf(body, i);
  }
  return masses;
}

void redistributeWater(const btSoftBody& body, const std::vector<double>& arealDensities, Water& water) {
  const std::size_t oldCount = std::min(water.size(), static_cast<std::size_t>(body.m_nodes.size()));
  std::vector<int> fabrics = fabricsAfterCut(body, water);
  std::vector<double> dry = dryMasses(body, arealDensities, fabrics);
  std::vector<double> held(dry.size(), 0);
  const std::size_t newCount = dry.size() - oldCount;

  double freed = 0;
  for (std::size_t i = 0; i < oldCount; ++i) {
    const double ratio = dry[i] / water.totalMass(i);
    const bool isShared = inverseMassOf(body, i) > 0 && ratio < 1 - kMassRounding && newCount > 0;
    const double kept = isShared ? ratio : 1;
    held[i] = water.held(i) * kept;
    freed += water.held(i) - held[i];
    dry[i] = water.dryMass(i) * kept;
  }

  if (freed > 0) {
    // In proportion to mass and to how wet the surroundings are. Bullet gave each new node its wet mass: of that it may
    // hold as much as leaves it saturated, or, where water came from a fabric that holds more, as much as this.
    const std::vector<double> wet(dry.begin() + static_cast<std::ptrdiff_t>(oldCount), dry.end());
    std::vector<double> weights = neighbourWaterShare(body, water, newCount, freed / compensatedSum(wet));
    std::vector<double> rooms(newCount);
    std::vector<double> mostRooms(newCount);
    for (std::size_t k = 0; k < newCount; ++k) {
      weights[k] *= wet[k];
      rooms[k] = wet[k] * waterShare(water.capacityRatio(toSize(fabrics[oldCount + k])));
      mostRooms[k] = wet[k] * waterShare(largestCapacityRatio(water));
    }
    if (freed > compensatedSum(rooms)) rooms = std::move(mostRooms);
    const std::vector<double> shares = shareOut(freed, weights, rooms);
    for (std::size_t k = 0; k < newCount; ++k) {
      held[oldCount + k] = shares[k];
      // More than its room only where the user had overfilled the cloth.
      dry[oldCount + k] = wet[k] - std::min(shares[k], rooms[k]);
    }
  }
  water.replaceNodes(std::move(dry), std::move(held), std::move(fabrics));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
