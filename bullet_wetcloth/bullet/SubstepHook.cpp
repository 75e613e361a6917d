// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/SubstepHook.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/bullet/RunningMark.h"

#include <map>
#include <mutex>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// The slots are protected and have no getter; a pointer to member named through a derived class may reach them.
struct Slots : btDynamicsWorld {
  static btInternalTickCallback& of(btDynamicsWorld& world, SubstepHook::Slot slot) {
    return slot == SubstepHook::Slot::preTick ? world.*(&Slots::m_internalPreTickCallback)
                                              : world.*(&Slots::m_internalTickCallback);
  }
};

// What we know of one slot.
struct Shared {
  btInternalTickCallback applicationCallback = nullptr;
  bool isRunning = false;  // a callback that was put on top of ours and calls it must not make a circle
  bool isHeld = false;     // ours is in it, or was when somebody took it who may call ours
};

struct Entry {
  const SubstepHook* hook = nullptr;
  Shared preTick;
  Shared tick;
  Shared& of(SubstepHook::Slot slot) { return slot == SubstepHook::Slot::preTick ? preTick : tick; }
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

void onPreTick(btDynamicsWorld* world, btScalar dt);
void onTick(btDynamicsWorld* world, btScalar dt);

btInternalTickCallback ours(SubstepHook::Slot slot) { return slot == SubstepHook::Slot::preTick ? onPreTick : onTick; }

void putBack(btDynamicsWorld& world, Entry& entry, SubstepHook::Slot slot) {
  btInternalTickCallback& callback = Slots::of(world, slot);
  if (callback == ours(slot)) callback = entry.of(slot).applicationCallback;
}

void call(SubstepHook::Slot slot, btDynamicsWorld* world, btScalar dt) {
  Entry* const entry = findEntry(world);
  if (!entry || entry->of(slot).isRunning) return;
  Shared& shared = entry->of(slot);
  const RunningMark mark(shared.isRunning);
  if (shared.applicationCallback) shared.applicationCallback(world, dt);
  if (entry->hook) {
    entry->hook->call(slot, dt);
  } else {
    putBack(*world, *entry, slot);
  }
}

void onPreTick(btDynamicsWorld* world, btScalar dt) { call(SubstepHook::Slot::preTick, world, dt); }
void onTick(btDynamicsWorld* world, btScalar dt) { call(SubstepHook::Slot::tick, world, dt); }

// Whether somebody took the slot after us, and may call us to reach the application's callback.
bool mayStillBeCalled(btDynamicsWorld& world, Entry& entry, SubstepHook::Slot slot) {
  const btInternalTickCallback applicationCallback = entry.of(slot).applicationCallback;
  return applicationCallback && Slots::of(world, slot) != applicationCallback;
}

}  // namespace

SubstepHook::SubstepHook(btDynamicsWorld& world, Callback onPreTick, Callback onTick)
    : m_world(world), m_onPreTick(std::move(onPreTick)), m_onTick(std::move(onTick)) {
  const std::lock_guard<std::mutex> lock(registryMutex());
  Entry& entry = registry()[&m_world];
  if (entry.hook) reject("world", "has a WetClothWorld already");
  entry.hook = this;
}

SubstepHook::~SubstepHook() {
  const std::lock_guard<std::mutex> lock(registryMutex());
  const auto found = registry().find(&m_world);
  if (found == registry().end()) return;
  Entry& entry = found->second;
  entry.hook = nullptr;
  if (entry.preTick.isRunning || entry.tick.isRunning) return;  // by an application's callback: the entry is in use
  if (entry.preTick.isHeld || entry.tick.isHeld) return;
  registry().erase(found);
}

void SubstepHook::take(Slot slot) {
  const std::lock_guard<std::mutex> lock(registryMutex());
  btInternalTickCallback& callback = Slots::of(m_world, slot);
  Shared& shared = registry()[&m_world].of(slot);
  shared.isHeld = true;
  if (callback == ours(slot)) return;
  shared.applicationCallback = callback;
  callback = ours(slot);
}

void SubstepHook::giveBack(Slot slot) {
  const std::lock_guard<std::mutex> lock(registryMutex());
  const auto found = registry().find(&m_world);
  if (found == registry().end()) return;
  putBack(m_world, found->second, slot);
  found->second.of(slot).isHeld = mayStillBeCalled(m_world, found->second, slot);
}

bool SubstepHook::isInPlace(Slot slot) const { return Slots::of(m_world, slot) == ours(slot); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
