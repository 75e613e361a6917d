// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/solver/ClothSolver.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Who sees the nodes' places after each small step: the application, and what observes for it.
class SmallStepViewers {
 public:
  bool empty() const { return !m_callback && m_observers.empty(); }
  void setCallback(ClothSolver::SmallStepCallback callback) { m_callback = std::move(callback); }
  void add(const std::shared_ptr<ClothSolver::SmallStepObserver>& observer) {
    const auto isIt = [&](const Observer& known) {
      return !known.owner_before(observer) && !observer.owner_before(known);
    };
    if (std::none_of(m_observers.begin(), m_observers.end(), isIt)) m_observers.push_back(observer);
  }
  void forgetTheDead() {
    const auto isDead = [](const Observer& observer) { return observer.expired(); };
    m_observers.erase(std::remove_if(m_observers.begin(), m_observers.end(), isDead), m_observers.end());
  }
  void show(const ClothSolver::SmallStepView& view) {
    if (m_callback && !m_failure) showToApplication(view);
    for (const Observer& observer : m_observers) {
      if (const auto living = observer.lock()) living->afterSmallStep(view);
    }
  }

  /// What the application's callback threw, which then is no longer called.
  std::optional<std::string> dropFailed() {
    if (m_failure) m_callback = nullptr;
    return std::exchange(m_failure, std::nullopt);
  }

 private:
  using Observer = std::weak_ptr<ClothSolver::SmallStepObserver>;

  // Through Bullet's step nothing may be thrown: it would be left half done.
  void showToApplication(const ClothSolver::SmallStepView& view) {
    try {
      m_callback(view);
    } catch (...) {
      m_failure = currentMessage();
    }
  }

  ClothSolver::SmallStepCallback m_callback;
  std::optional<std::string> m_failure;
  std::vector<Observer> m_observers;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
