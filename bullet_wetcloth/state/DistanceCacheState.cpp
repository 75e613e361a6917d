// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/DistanceCacheState.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using DistanceCache = btSparseSdf<3>;  // as in btSoftBodyWorldInfo

std::vector<DistanceCache*> cachesOf(const SoftBodyArray& bodies) {
  std::vector<DistanceCache*> caches;
  for (int i = 0; i < bodies.size(); ++i) {
    DistanceCache* const cache = &bodies[i]->getWorldInfo()->m_sparsesdf;
    const bool isUsed = cache->cells.size() > 0;
    if (isUsed && std::find(caches.begin(), caches.end(), cache) == caches.end()) caches.push_back(cache);
  }
  return caches;
}

// Of the shapes that are there now, with the number of an object that has it. A cell of another one may tell of a shape
// that is gone.
using Shapes = std::unordered_map<const btCollisionShape*, int>;

void addConvex(Shapes& shapes, const btCollisionShape& shape, int object) {
  if (shape.isConvex()) shapes.emplace(&shape, object);
  if (!shape.isCompound()) return;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) addConvex(shapes, *compound.getChildShape(i), object);
}

Shapes shapesOf(const btCollisionWorld& world) {
  Shapes shapes;
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) addConvex(shapes, *objects[i]->getCollisionShape(), i);
  return shapes;
}

bool isUpToDate(DistanceCache& cache, const DistanceCache::Cell& cell) {
  DistanceCache::Cell now = cell;
  cache.BuildCell(now);
  return std::memcmp(now.d, cell.d, sizeof cell.d) == 0;
}

void requireUpToDate(StateArchive& archive, DistanceCache& cache, const Shapes& shapes) {
  for (int i = 0; i < cache.cells.size(); ++i) {
    for (const DistanceCache::Cell* cell = cache.cells[i]; cell; cell = cell->next) {
      const auto shape = shapes.find(cell->pclient);
      if (shape == shapes.end() || isUpToDate(cache, *cell)) continue;
      archive.fail("the shape of collision object " + std::to_string(shape->second) +
                   " was changed, and m_sparsesdf still has its old distances: call its RemoveReferences()");
    }
  }
}

}  // namespace

void transferDistanceCaches(StateArchive& archive, btCollisionWorld& world, const SoftBodyArray& bodies) {
  const std::vector<DistanceCache*> caches = cachesOf(bodies);
  const Shapes shapes = archive.isSaving() ? shapesOf(world) : Shapes();
  archive.expect(caches.size(), "the number of caches of distances");
  for (DistanceCache* const cache : caches) {
    if (archive.isSaving()) requireUpToDate(archive, *cache, shapes);
    btScalar cellSize = cache->voxelsz;
    archive.local(cellSize);
    if (!(cellSize > 0)) archive.fail("m_sparsesdf has cells of the size " + std::to_string(cellSize));
    if (!archive.isRestoring()) continue;
    cache->Reset();
    cache->voxelsz = cellSize;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
