// SPDX-License-Identifier: Zlib
#pragma once

#include <chrono>
#include <string>

namespace command {

/// Says on standard error how far a long task is and how much longer it will take, once it has taken more than two
/// seconds: one line with a bar, rewritten, on a terminal; a line now and then elsewhere.
class Progress {
 public:
  explicit Progress(std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param fraction done, [0, 1]
  void update(double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  std::string timeLeft(double fraction, Clock::time_point now) const;

  std::string m_task;
  bool m_onTerminal;
  bool m_shown = false;
  Clock::time_point m_start;
  Clock::time_point m_next;
};

}  // namespace command
