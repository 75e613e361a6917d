#include "Gnuplot.h"

#include "Errors.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

#ifdef _WIN32
#include <process.h>
#else
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace runner {
namespace {

constexpr int notThere = -1;

#ifdef _WIN32

int statusOfGnuplot(const std::string& script, const std::string&) {
  const intptr_t status = _spawnlp(_P_WAIT, "gnuplot", "gnuplot", script.c_str(), nullptr);
  return status == -1 && errno == ENOENT ? notThere : static_cast<int>(status);
}

#else

int statusOfGnuplot(const std::string& script, const std::string& log) {
  std::string words[] = {"gnuplot", script};
  char* arguments[] = {words[0].data(), words[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // Standard output may be the command's JSON.
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed == ENOENT) return notThere;
  if (failed != 0) throw RunError("wetcloth: gnuplot could not be started");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

#endif

std::string contentsOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return onOneLine({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
}

}  // namespace

bool runGnuplot(const std::string& script, const std::string& log) {
  const int status = statusOfGnuplot(script, log);
  if (status == notThere) return false;
  if (status == 0) return true;
  const std::string complaint = contentsOf(log);
  throw RunError("wetcloth: gnuplot failed with status " + std::to_string(status) +
                 (complaint.empty() ? "" : ": " + complaint));
}

}  // namespace runner
