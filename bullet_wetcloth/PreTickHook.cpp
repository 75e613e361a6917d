#include "bullet_wetcloth/PreTickHook.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"

#include <map>
#include <mutex>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// m_internalPreTickCallback is protected and has no getter; a pointer to member named through a derived class may
// reach it.
struct PreTickSlot : btDynamicsWorld {
  static btInternalTickCallback& of(btDynamicsWorld& world) { return world.*(&PreTickSlot::m_internalPreTickCallback); }
};

struct Entry {
  WetClothWorld* wetWorld = nullptr;
  btInternalTickCallback applicationCallback = nullptr;
  bool isRunning = false;  // a callback that was put on top of ours and calls it must not make a circle
};

// Takes itself back when an application's callback throws.
class RunningMark {
 public:
  explicit RunningMark(bool& isRunning) : m_isRunning(isRunning) { m_isRunning = true; }
  ~RunningMark() { m_isRunning = false; }
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;

 private:
  bool& m_isRunning;
};

// Worlds may live in threads of their own.
std::mutex& registryMutex() {
  static std::mutex mutex;
  return mutex;
}

// A map: its entries stay where they are while others come and go.
std::map<btDynamicsWorld*, Entry>& registry() {
  static std::map<btDynamicsWorld*, Entry> entries;
  return entries;
}

Entry* findEntry(btDynamicsWorld* world) {
  const std::lock_guard<std::mutex> lock(registryMutex());
  const auto found = registry().find(world);
  return found == registry().end() ? nullptr : &found->second;
}

void onPreTick(btDynamicsWorld* world, btScalar dt) {
  Entry* const entry = findEntry(world);
  if (!entry || entry->isRunning) return;
  const RunningMark mark(entry->isRunning);
  if (entry->applicationCallback) entry->applicationCallback(world, dt);
  if (entry->wetWorld) entry->wetWorld->preTick(dt);
}

}  // namespace

void PreTickHook::attach(WetClothWorld& wetWorld, bool takeSlot) {
  btDynamicsWorld& world = wetWorld.world();
  const std::lock_guard<std::mutex> lock(registryMutex());
  Entry& entry = registry()[&world];
  if (entry.wetWorld) reject("world", "has a WetClothWorld already");
  entry.wetWorld = &wetWorld;
  btInternalTickCallback& slot = PreTickSlot::of(world);
  if (!takeSlot || slot == onPreTick) return;
  entry.applicationCallback = slot;
  slot = onPreTick;
}

void PreTickHook::detach(WetClothWorld& wetWorld) {
  btDynamicsWorld& world = wetWorld.world();
  const std::lock_guard<std::mutex> lock(registryMutex());
  const auto found = registry().find(&world);
  if (found == registry().end()) return;
  found->second.wetWorld = nullptr;
  btInternalTickCallback& slot = PreTickSlot::of(world);
  if (slot == onPreTick) slot = found->second.applicationCallback;
  const bool isStillCalled = slot != found->second.applicationCallback && found->second.applicationCallback;
  if (!isStillCalled) registry().erase(found);
}

bool PreTickHook::isInPlace(btDynamicsWorld& world) { return PreTickSlot::of(world) == onPreTick; }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
