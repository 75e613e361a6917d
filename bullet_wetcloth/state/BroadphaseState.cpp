// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/BroadphaseState.h"

#include "bullet_wetcloth/state/BulletClass.h"
#include "bullet_wetcloth/state/TreeState.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btDbvtProxy* proxyOf(const btCollisionObject& object) {
  return static_cast<btDbvtProxy*>(const_cast<btBroadphaseProxy*>(object.getBroadphaseHandle()));
}

int indexOf(const btCollisionObjectArray& objects, const void* proxy) {
  for (int i = 0; i < objects.size(); ++i) {
    if (objects[i]->getBroadphaseHandle() == proxy) return i;
  }
  return -1;
}

void transferCounters(StateArchive& archive, btDbvtBroadphase& broadphase) {
  archive.value(broadphase.m_prediction, broadphase.m_stageCurrent, broadphase.m_fupdates, broadphase.m_dupdates);
  archive.value(broadphase.m_cupdates, broadphase.m_newpairs, broadphase.m_fixedleft, broadphase.m_updates_call);
  archive.value(broadphase.m_updates_done, broadphase.m_updates_ratio, broadphase.m_pid, broadphase.m_cid);
  archive.value(broadphase.m_gid, broadphase.m_deferedcollide, broadphase.m_needcleanup);
}

void transferProxies(StateArchive& archive, const btCollisionObjectArray& objects) {
  for (int i = 0; i < objects.size(); ++i) {
    btDbvtProxy& proxy = *proxyOf(*objects[i]);
    archive.value(proxy.m_aabbMin, proxy.m_aabbMax, proxy.m_uniqueId);
  }
}

// Those that have moved in this step, in the last one, and not lately: each list in its order.
std::vector<int> stageOf(const btDbvtBroadphase& broadphase, int stage, const btCollisionObjectArray& objects) {
  std::vector<int> members;
  for (const btDbvtProxy* proxy = broadphase.m_stageRoots[stage]; proxy; proxy = proxy->links[1]) {
    members.push_back(indexOf(objects, proxy));
  }
  return members;
}

void linkStage(btDbvtBroadphase& broadphase, int stage, const btCollisionObjectArray& objects,
               const std::vector<int>& members) {
  btDbvtProxy* before = nullptr;
  broadphase.m_stageRoots[stage] = nullptr;
  for (const int member : members) {
    btDbvtProxy* const proxy = proxyOf(*objects[member]);
    proxy->stage = stage;
    proxy->links[0] = before;
    proxy->links[1] = nullptr;
    (before ? before->links[1] : broadphase.m_stageRoots[stage]) = proxy;
    before = proxy;
  }
}

// Returns the stage of each object.
std::vector<int> transferStages(StateArchive& archive, btDbvtBroadphase& broadphase,
                                const btCollisionObjectArray& objects) {
  std::vector<int> stages(static_cast<std::size_t>(objects.size()), -1);
  std::size_t known = 0;
  for (int stage = 0; stage <= btDbvtBroadphase::STAGECOUNT; ++stage) {
    std::vector<int> members;
    if (archive.isSaving()) members = stageOf(broadphase, stage, objects);
    members.resize(archive.count(members.size()));
    for (int& member : members) {
      member = archive.place(member, objects.size(), "object of the broadphase");
      int& where = stages[static_cast<std::size_t>(member)];
      if (where >= 0) archive.fail("an object is in the broadphase twice");
      where = stage;
      ++known;
    }
    if (archive.isRestoring()) linkStage(broadphase, stage, objects, members);
  }
  if (known != stages.size()) archive.fail("an object is not in the broadphase");
  return stages;
}

TreeLeaves leavesOf(const btCollisionObjectArray& objects) {
  TreeLeaves leaves;
  leaves.what = "object of the broadphase";
  leaves.size = objects.size();
  leaves.indexOf = [&](const void* data) { return indexOf(objects, data); };
  leaves.dataOf = [&](int index) -> void* { return proxyOf(*objects[index]); };
  leaves.tell = [&](int index, btDbvtNode& leaf) { proxyOf(*objects[index])->leaf = &leaf; };
  return leaves;
}

void transferDynamicTrees(StateArchive& archive, btDbvtBroadphase& broadphase, const btCollisionObjectArray& objects) {
  transferCounters(archive, broadphase);
  transferProxies(archive, objects);
  const std::vector<int> stages = transferStages(archive, broadphase, objects);
  for (int set = 0; set < 2; ++set) {
    const std::vector<bool> has = transferTree(archive, broadphase.m_sets[set], leavesOf(objects));
    for (std::size_t i = 0; i < stages.size(); ++i) {
      const bool isFixed = stages[i] == btDbvtBroadphase::STAGECOUNT;
      if (has[i] != (isFixed == (set == btDbvtBroadphase::FIXED_SET))) {
        archive.fail("an object is in the wrong tree of the broadphase");
      }
    }
  }
}

using Overlap = std::pair<int, int>;

std::vector<Overlap> pairsOf(const btCollisionWorld& world) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  const btOverlappingPairCache& cache = *world.getBroadphase()->getOverlappingPairCache();
  std::vector<Overlap> pairs;
  for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
    const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
    pairs.emplace_back(indexOf(objects, pair.m_pProxy0), indexOf(objects, pair.m_pProxy1));
  }
  return pairs;
}

void setPairs(btCollisionWorld& world, const std::vector<Overlap>& pairs) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  btOverlappingPairCache& cache = *world.getBroadphase()->getOverlappingPairCache();
  if (pairsOf(world) == pairs) return;
  while (cache.getNumOverlappingPairs() > 0) {
    const btBroadphasePair pair = cache.getOverlappingPairArrayPtr()[cache.getNumOverlappingPairs() - 1];
    cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, world.getDispatcher());
  }
  for (const Overlap& pair : pairs) {
    cache.addOverlappingPair(objects[pair.first]->getBroadphaseHandle(), objects[pair.second]->getBroadphaseHandle());
  }
}

void transferPairs(StateArchive& archive, btCollisionWorld& world) {
  const int size = world.getNumCollisionObjects();
  std::vector<Overlap> pairs;
  if (archive.isSaving()) pairs = pairsOf(world);
  pairs.resize(archive.count(pairs.size()));
  for (Overlap& pair : pairs) {
    pair.first = archive.place(pair.first, size, "object of an overlapping pair");
    pair.second = archive.place(pair.second, size, "object of an overlapping pair");
    if (pair.first == pair.second) archive.fail("an object overlaps itself");
  }
  if (archive.isRestoring()) setPairs(world, pairs);
}

}  // namespace

void transferBroadphase(StateArchive& archive, btCollisionWorld& world) {
  btDbvtBroadphase* const broadphase = asDbvtBroadphase(world.getBroadphase());
  if (!broadphase) archive.fail("the world's broadphase is not a btDbvtBroadphase; the state of others is not saved");
  if (world.getPairCache()->hasDeferredRemoval()) {
    archive.fail(
        "the broadphase's pair cache removes pairs later (btSortedOverlappingPairCache): its order is not saved");
  }
  transferDynamicTrees(archive, *broadphase, world.getCollisionObjectArray());
  transferPairs(archive, world);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
