// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btThreads.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace wetcloth_test {

/// A task scheduler as an application may set one: this thread and another, which looks for work for a while before it
/// sleeps, as Bullet's own does.
class TwoThreads : public btITaskScheduler {
 public:
  TwoThreads() : btITaskScheduler("TwoThreads"), m_other([this] { work(); }) {}
  ~TwoThreads() override {
    m_isOver = true;
    wake();
    m_other.join();
  }
  TwoThreads(const TwoThreads&) = delete;
  TwoThreads& operator=(const TwoThreads&) = delete;

  /// How often it had a loop to share out.
  int calls() const { return m_calls; }

  int getMaxNumThreads() const override { return 2; }
  int getNumThreads() const override { return 2; }
  void setNumThreads(int) override {}
  void parallelFor(int begin, int end, int, const btIParallelForBody& body) override {
    ++m_calls;
    m_body = &body;
    m_next = begin;
    m_end = end;
    m_isBusy = true;
    wake();
    takeParts();
    while (m_isBusy) std::this_thread::yield();
  }
  btScalar parallelSum(int begin, int end, int, const btIParallelSumBody& body) override {
    return body.sumLoop(begin, end);
  }

 private:
  bool hasNews() const { return m_isBusy || m_isOver; }
  void wake() {
    { const std::lock_guard<std::mutex> lock(m_mutex); }
    m_wake.notify_one();
  }
  void takeParts() {
    for (int part = m_next++; part < m_end; part = m_next++) m_body->forLoop(part, part + 1);
  }
  void work() {
    while (!m_isOver) {
      constexpr int kLooks = 2000;
      for (int look = 0; look < kLooks && !hasNews(); ++look) std::this_thread::yield();
      if (!hasNews()) {
        std::unique_lock<std::mutex> lock(m_mutex);
        m_wake.wait(lock, [this] { return hasNews(); });
      }
      if (m_isBusy) takeParts();
      m_isBusy = false;
    }
  }

  std::mutex m_mutex;
  std::condition_variable m_wake;
  std::atomic<bool> m_isBusy{false};
  std::atomic<bool> m_isOver{false};
  const btIParallelForBody* m_body = nullptr;
  std::atomic<int> m_next{0};
  int m_end = 0;
  int m_calls = 0;
  std::thread m_other;
};

}  // namespace wetcloth_test
