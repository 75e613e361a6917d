#include "Progress.h"

#include <cstdio>
#include <utility>

#ifdef _WIN32
#include <io.h>
#define isatty _isatty
#define fileno _fileno
#else
#include <unistd.h>
#endif

namespace runner {

Progress::Progress(std::string task)
    : m_task(std::move(task)),
      m_onTerminal(isatty(fileno(stderr)) != 0),
      m_next(Clock::now() + std::chrono::seconds(2)) {}

Progress::~Progress() {
  if (m_shown && m_onTerminal) std::fputs("\r\033[K", stderr);
}

void Progress::update(double fraction) {
  const Clock::time_point now = Clock::now();
  if (now < m_next) return;
  m_next = now + (m_onTerminal ? std::chrono::milliseconds(100) : std::chrono::milliseconds(5000));
  m_shown = true;
  const char* const format = m_onTerminal ? "\r%s: %3.0f %%\033[K" : "%s: %3.0f %%\n";
  std::fprintf(stderr, format, m_task.c_str(), 100 * fraction);
  std::fflush(stderr);
}

}  // namespace runner
