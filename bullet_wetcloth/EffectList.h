// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/Range.h"

#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The effects of a cloth, in the order in which the step runs them: by their stages, and within a stage as they were
/// added.
///
/// Effects of the library do not throw in a step, but a user's own may, and an exception must not travel through
/// Bullet's step: an effect that throws there is removed, with a message to the world's log.
class WETCLOTH_EXPORT EffectList {
 public:
  /// An effect, and the class that it was added as: &EffectType<E>::tag, or null when that was no more than Effect.
  struct Entry {
    std::unique_ptr<Effect> effect;  ///< never null
    const void* type;                ///< the address of its EffectType::tag, or null
    /// For Range.
    Effect& operator*() const { return *effect; }
  };

  /// For the effects of this cloth, which must outlive it.
  explicit EffectList(WetCloth& cloth) : m_cloth(cloth) {}

  /// Attaches the effect, which must not be null, and takes it. Throws what its attach() throws, and then nothing
  /// changes.
  Effect& add(std::unique_ptr<Effect> effect, const void* type);
  /// Detaches and deletes the effect. Throws std::invalid_argument when it is not in the list.
  void remove(Effect& effect);
  /// The same of all, when the cloth goes: what a detach() throws ends in the log.
  void clear();

  /// Whether there are no effects.
  bool empty() const { return m_entries.empty(); }
  /// Whether one of them runs at this stage.
  bool has(Stage stage) const;
  /// The first that was added as this class, or null.
  Effect* find(const void* type) const {
    for (const Entry& entry : m_entries) {
      if (entry.type == type) return entry.effect.get();
    }
    return nullptr;
  }
  /// Whether one of this Effect::name() is there, other than `but`; whatever class it was added as.
  bool has(const char* name, const Effect* but = nullptr) const;
  /// In the order in which they run.
  const std::vector<Entry>& entries() const { return m_entries; }

  /// Applies the effects of these stages, both included. False: one threw and was removed. Never throws.
  bool apply(Stage first, Stage last, const Step& step);
  /// The body changed. False: one threw and was removed. Never throws.
  bool attachAgain();
  /// Whether one of them would wake the body. One that throws is removed. Never throws.
  bool wakes(const Step& step);

  /// Each effect's own, by its name.
  void transferState(StateArchive& archive);

 private:
  template <class Action>
  bool guarded(std::size_t index, Action action);
  void applyOne(Effect& effect, const Step& step);
  void detachGuarded(Effect& effect);

  WetCloth& m_cloth;
  std::vector<Entry> m_entries;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
