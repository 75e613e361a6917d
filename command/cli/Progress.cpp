// SPDX-License-Identifier: Zlib
#include "command/cli/Progress.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

#ifdef _WIN32
#include <io.h>
#define isatty _isatty
#define fileno _fileno
#else
#include <unistd.h>
#endif

namespace command {

Progress::Progress(std::string task)
    : m_task(std::move(task)),
      m_onTerminal(isatty(fileno(stderr)) != 0),
      m_start(Clock::now()),
      m_next(m_start + std::chrono::seconds(2)) {}

Progress::~Progress() {
  if (m_shown && m_onTerminal) std::fputs("\r\033[K", stderr);
}

std::string Progress::timeLeft(double fraction, Clock::time_point now) const {
  if (!(fraction > 0)) return "";
  const double taken = std::chrono::duration<double>(now - m_start).count();
  const long seconds = std::lround(taken * (1 - fraction) / fraction);
  char text[48];
  if (seconds < 60) {
    std::snprintf(text, sizeof text, ", %ld s left", seconds);
  } else {
    std::snprintf(text, sizeof text, ", %ld min %02ld s left", seconds / 60, seconds % 60);
  }
  return text;
}

void Progress::update(double fraction) {
  const Clock::time_point now = Clock::now();
  if (now < m_next) return;
  m_next = now + (m_onTerminal ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000));
  m_shown = true;
  const std::string left = timeLeft(fraction, now);
  if (m_onTerminal) {
    constexpr int width = 24;
    const int done = static_cast<int>(fraction * width);
    const std::string bar =
        std::string(static_cast<std::size_t>(done), '#') + std::string(static_cast<std::size_t>(width - done), '.');
    std::fprintf(stderr, "\r%s [%s] %.0f %%%s\033[K", m_task.c_str(), bar.c_str(), 100 * fraction, left.c_str());
  } else {
    std::fprintf(stderr, "%s: %3.0f %%%s\n", m_task.c_str(), 100 * fraction, left.c_str());
  }
  std::fflush(stderr);
}

}  // namespace command
