// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/EffectList.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

Effect& EffectList::add(std::unique_ptr<Effect> effect, const void* type) {
  effect->attach(m_cloth);
  const auto isLater = [](Stage stage, const Entry& other) { return stage < other.effect->stage(); };
  const auto position = std::upper_bound(m_entries.begin(), m_entries.end(), effect->stage(), isLater);
  return **m_entries.insert(position, Entry{std::move(effect), type});
}

void EffectList::remove(Effect& effect) {
  const auto isIt = [&](const Entry& entry) { return entry.effect.get() == &effect; };
  const auto position = std::find_if(m_entries.begin(), m_entries.end(), isIt);
  if (position == m_entries.end()) reject(std::string("effect ") + effect.name(), "is not one of this cloth's effects");
  effect.detach(m_cloth);
  m_entries.erase(position);
}

void EffectList::clear() {
  for (const Entry& entry : m_entries) detachGuarded(*entry);
  m_entries.clear();
}

bool EffectList::has(Stage stage) const {
  return std::any_of(m_entries.begin(), m_entries.end(),
                     [stage](const Entry& entry) { return entry.effect->stage() == stage; });
}

bool EffectList::has(const char* name, const Effect* but) const {
  return std::any_of(m_entries.begin(), m_entries.end(), [&](const Entry& entry) {
    return entry.effect.get() != but && std::strcmp(entry.effect->name(), name) == 0;
  });
}

bool EffectList::apply(Stage first, Stage last, const Step& step) {
  bool allWell = true;
  std::size_t next = 0;
  while (next < m_entries.size() && m_entries[next].effect->stage() < first) ++next;
  while (next < m_entries.size() && m_entries[next].effect->stage() <= last) {
    const bool isWell = guarded(next, [&](Effect& effect) { applyOne(effect, step); });
    if (isWell) ++next;
    allWell = allWell && isWell;
  }
  m_cloth.packedNodes().keep();
  return allWell;
}

void EffectList::applyOne(Effect& effect, const Step& step) {
  if (effect.usesPackedNodes()) {
    m_cloth.packedNodes().hold();
  } else {
    m_cloth.packedNodes().release();
  }
  effect.apply(m_cloth, step);
}

bool EffectList::attachAgain() {
  bool allWell = true;
  for (std::size_t next = 0; next < m_entries.size();) {
    const bool isWell = guarded(next, [&](Effect& effect) { effect.attach(m_cloth); });
    if (isWell) ++next;
    allWell = allWell && isWell;
  }
  return allWell;
}

bool EffectList::wakes(const Step& step) {
  bool one = false;
  for (std::size_t next = 0; next < m_entries.size() && !one;) {
    if (guarded(next, [&](const Effect& effect) { one = effect.wakes(m_cloth, step); })) ++next;
  }
  return one;
}

// Whether the action ended without an exception. Otherwise the effect is no longer in the list.
template <class Action>
bool EffectList::guarded(std::size_t index, Action action) {
  std::string reason;
  try {
    action(*m_entries[index]);
    return true;
  } catch (...) {
    reason = currentMessage();
  }
  m_cloth.log(std::string("wetcloth: effect ") + m_entries[index].effect->name() + " removed: " + reason);
  const Entry failed = std::move(m_entries[index]);
  m_entries.erase(m_entries.begin() + static_cast<std::ptrdiff_t>(index));
  detachGuarded(*failed);
  return false;
}

void EffectList::detachGuarded(Effect& effect) {
  try {
    effect.detach(m_cloth);
  } catch (...) {
    m_cloth.log(std::string("wetcloth: effect ") + effect.name() + " could not give back what it changed");
  }
}

void EffectList::transferState(StateArchive& archive) {
  archive.expect(m_entries.size(), "a cloth's number of effects");
  for (const Entry& entry : m_entries) {
    const std::string name = entry.effect->name();
    archive.expect(name, "an effect's name");
    archive.section("the effect " + name, [&] { entry.effect->transferState(archive); });
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
