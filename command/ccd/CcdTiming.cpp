// SPDX-License-Identifier: Zlib
#include "command/ccd/CcdTiming.h"

#include "command/cli/Progress.h"
#include "command/timing/Quantile.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>
#include <vector>

namespace command {
namespace {

using wetcloth::collision::Contact;
using Clock = std::chrono::steady_clock;

template <class Task>
double nanosecondsOf(const Task& task) {
  const Clock::time_point start = Clock::now();
  task();
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// What a measurement of nothing shows.
double clockCost() {
  std::vector<double> costs(1001);
  for (double& cost : costs) cost = nanosecondsOf([] {});
  return median(std::move(costs));
}

/// Without a clock among the queries.
double meanOf(const CcdMethod& method, int passes) {
  std::vector<Contact> contacts(method.count());
  std::vector<double> times(static_cast<std::size_t>(passes));
  for (double& time : times) time = nanosecondsOf([&] { method.answer(0, method.count(), contacts.data()); });
  return median(std::move(times)) / static_cast<double>(method.count());
}

/// Of each query, or each batch: all are asked in turn, as a program asks them. One that is repeated at once is found
/// in the cache and its branches are foreseen, which flatters it.
std::vector<double> timeOfEach(const CcdMethod& method, int passes) {
  const std::size_t size = std::min(method.batch(), method.count());
  const std::size_t batches = (method.count() + size - 1) / size;
  const double clock = clockCost();
  std::vector<Contact> contacts(size);
  std::vector<std::vector<double>> times(batches);
  Progress progress("timing");
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < batches; ++i) {
      // The last batch reaches back into the one before it, so that all are of one size.
      const std::size_t first = std::min(i * size, method.count() - size);
      const double time = nanosecondsOf([&] { method.answer(first, size, contacts.data()); });
      times[i].push_back(std::max(0., time - clock) / static_cast<double>(size));
    }
    progress.update((pass + 1.) / passes);
  }
  std::vector<double> medians;
  for (std::vector<double>& ofOne : times) medians.push_back(median(std::move(ofOne)));
  return medians;
}

}  // namespace

CcdTimes timeOf(const CcdMethod& method, int passes) {
  CcdTimes times;
  times.mean = meanOf(method, passes);
  std::vector<double> each = timeOfEach(method, passes);
  times.median = median(each);
  times.p99 = quantile(each, 0.99);
  times.worst = quantile(std::move(each), 1);
  return times;
}

}  // namespace command
