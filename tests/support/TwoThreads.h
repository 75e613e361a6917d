// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btThreads.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace wetcloth_test {

/// A task scheduler as an application may set one: this thread and another, which waits in between.
class TwoThreads : public btITaskScheduler {
 public:
  TwoThreads() : btITaskScheduler("TwoThreads"), m_other([this] { work(); }) {}
  ~TwoThreads() override {
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_isOver = true;
    }
    m_wake.notify_one();
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
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_isBusy = true;
    }
    m_wake.notify_one();
    takeParts();
    std::unique_lock<std::mutex> lock(m_mutex);
    m_done.wait(lock, [this] { return !m_isBusy; });
  }
  btScalar parallelSum(int begin, int end, int, const btIParallelSumBody& body) override {
    return body.sumLoop(begin, end);
  }

 private:
  void takeParts() {
    for (int part = m_next++; part < m_end; part = m_next++) m_body->forLoop(part, part + 1);
  }
  void work() {
    std::unique_lock<std::mutex> lock(m_mutex);
    while (true) {
      m_wake.wait(lock, [this] { return m_isBusy || m_isOver; });
      if (m_isOver) return;
      lock.unlock();
      takeParts();
      lock.lock();
      m_isBusy = false;
      m_done.notify_one();
    }
  }

  std::mutex m_mutex;
  std::condition_variable m_wake;
  std::condition_variable m_done;
  bool m_isBusy = false;
  bool m_isOver = false;
  const btIParallelForBody* m_body = nullptr;
  std::atomic<int> m_next{0};
  int m_end = 0;
  int m_calls = 0;
  std::thread m_other;
};

}  // namespace wetcloth_test
