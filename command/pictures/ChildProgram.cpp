// SPDX-License-Identifier: Zlib
#include "command/pictures/ChildProgram.h"

#include "command/pictures/Unavailable.h"

#ifdef _WIN32

namespace pictures {

ChildProgram::ChildProgram(const std::vector<std::string>& words) {
  throw Unavailable(words.front() + " is not started on this system");
}
ChildProgram::~ChildProgram() = default;
bool ChildProgram::write(const std::vector<std::uint8_t>&) { return false; }
bool ChildProgram::finish() { return false; }
std::string ChildProgram::complaint() const { return {}; }

}  // namespace pictures

#else

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX wants it, glibc does not need it

namespace pictures {
namespace {

/// While it lives, writing to a program that is gone is an error of the write and does not end this one.
class SigpipeIgnored {
 public:
  SigpipeIgnored() : m_before(std::signal(SIGPIPE, SIG_IGN)) {}
  ~SigpipeIgnored() { std::signal(SIGPIPE, m_before); }
  SigpipeIgnored(const SigpipeIgnored&) = delete;
  SigpipeIgnored& operator=(const SigpipeIgnored&) = delete;

 private:
  void (*m_before)(int);
};

/// A file without a name: a pipe would fill up while nobody reads it.
int unnamedFile() {
  std::string name = "/tmp/wetcloth-XXXXXX";
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) unlink(name.c_str());
  return file;
}

/// POSIX leaves to a system whether posix_spawn itself says that there is no such program, or the child ends with
/// this status: QEMU's does.
constexpr int statusWithoutProgram = 127;

std::string noProgram(const std::string& name) { return "there is no program " + name; }

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& words) : m_name(words.front()), m_errors(unnamedFile()) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error(std::strerror(errno));
  for (const int end : pipe) fcntl(end, F_SETFD, FD_CLOEXEC);  // the child must not hold its own input open
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (m_errors >= 0) posix_spawn_file_actions_adddup2(&actions, m_errors, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int failed = posix_spawnp(&m_process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe[0]);
  m_input = pipe[1];
  if (failed == 0) return;
  close(m_input);
  if (m_errors >= 0) close(m_errors);
  if (failed == ENOENT) throw Unavailable(noProgram(m_name));
  throw std::runtime_error(m_name + " cannot be started: " + std::strerror(failed));
}

ChildProgram::~ChildProgram() {
  if (m_input >= 0) close(m_input);
  if (m_process > 0) {
    kill(m_process, SIGKILL);
    waitpid(m_process, nullptr, 0);
  }
  if (m_errors >= 0) close(m_errors);
}

bool ChildProgram::write(const std::vector<std::uint8_t>& bytes) {
  const SigpipeIgnored ignored;
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(m_input, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

bool ChildProgram::finish() {
  close(m_input);
  m_input = -1;
  int status = -1;
  while (waitpid(m_process, &status, 0) < 0 && errno == EINTR) {
  }
  m_process = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == statusWithoutProgram) throw Unavailable(noProgram(m_name));
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string ChildProgram::complaint() const {
  std::string text;
  std::array<char, 4096> piece{};
  for (off_t at = 0;;) {
    const ssize_t count = pread(m_errors, piece.data(), piece.size(), at);
    if (count <= 0) break;
    text.append(piece.data(), static_cast<std::size_t>(count));
    at += count;
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t line = text.find_last_of("\n\r");
  return line == std::string::npos ? text : text.substr(line + 1);
}

}  // namespace pictures

#endif
