// SPDX-License-Identifier: Zlib
#include "command/stability/StabilityRun.h"

#include "command/stability/StabilityTable.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>

namespace stability {
namespace {

std::vector<double> stepsOf(const HardCase& hardCase, const Selection& selection) {
  if (hardCase.compute) return {0};
  if (selection.step) return {*selection.step};
  std::vector<double> steps = hardCase.stepSizes.empty() ? stabilitySteps() : hardCase.stepSizes;
  if (selection.effort == Effort::full) return steps;
  const auto isLeftOut = [](double step) {
    return std::find(quickSteps().begin(), quickSteps().end(), step) == quickSteps().end();
  };
  steps.erase(std::remove_if(steps.begin(), steps.end(), isLeftOut), steps.end());
  return steps;
}

/// What is left to do. Bullet's deformable world shuffles its contacts by a static seed, so two of them must not run at
/// the same time: one worker does them all.
class WorkList {
 public:
  explicit WorkList(const std::vector<Combination>& combinations) : m_combinations(combinations) {
    for (std::size_t i = 0; i < combinations.size(); ++i) {
      (isDeformable(combinations[i].world) ? m_deformable : m_others).push_back(i);
    }
  }

  /// The next one for this worker; false when there is none.
  bool take(bool doesDeformable, std::size_t& index) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    std::vector<std::size_t>& list = doesDeformable && !m_deformable.empty() ? m_deformable : m_others;
    if (list.empty() || m_failure) return false;
    index = list.back();  // the long cases are the table's last
    list.pop_back();
    return true;
  }
  const Combination& at(std::size_t index) const { return m_combinations[index]; }

  void fail(std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_failure = std::move(failure);
  }
  std::exception_ptr failure() const { return m_failure; }

 private:
  const std::vector<Combination>& m_combinations;
  std::vector<std::size_t> m_deformable;
  std::vector<std::size_t> m_others;
  std::mutex m_mutex;
  std::exception_ptr m_failure;
};

}  // namespace

std::vector<Combination> combinationsOf(const Selection& selection) {
  std::vector<Combination> combinations;
  for (const HardCase& hardCase : stabilityTable()) {
    if (!selection.name.empty() && hardCase.name != selection.name) continue;
    if (!selection.group.empty() && hardCase.group != selection.group) continue;
    for (const World world : hardCase.worlds) {
      if (selection.world && world != *selection.world) continue;
      for (const double step : stepsOf(hardCase, selection)) combinations.push_back({&hardCase, world, step});
    }
  }
  return combinations;
}

std::vector<CaseResult> runCombinations(const std::vector<Combination>& combinations, Effort effort,
                                        const std::function<void(double)>& progress) {
  std::vector<std::optional<CaseResult>> results(combinations.size());
  WorkList work(combinations);
  std::atomic<std::size_t> done{0};
  std::atomic<unsigned> busy{std::max(1U, std::thread::hardware_concurrency())};
  const auto run = [&](bool doesDeformable) {
    try {
      std::size_t index = 0;
      while (work.take(doesDeformable, index)) {
        const Combination& one = work.at(index);
        results[index] = tryCase(*one.hardCase, one.world, one.step, effort);
        ++done;
      }
    } catch (...) {
      work.fail(std::current_exception());
    }
    --busy;
  };
  std::vector<std::thread> workers;
  const unsigned count = busy;
  for (unsigned i = 0; i < count; ++i) workers.emplace_back(run, i == 0);
  while (busy > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    progress(combinations.empty() ? 1 : static_cast<double>(done) / static_cast<double>(combinations.size()));
  }
  for (std::thread& worker : workers) worker.join();
  if (work.failure()) std::rethrow_exception(work.failure());
  std::vector<CaseResult> finished;
  for (std::optional<CaseResult>& result : results) finished.push_back(std::move(*result));
  return finished;
}

}  // namespace stability
