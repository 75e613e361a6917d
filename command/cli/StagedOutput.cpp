// SPDX-License-Identifier: Zlib
#include "command/cli/StagedOutput.h"

#include "command/cli/Errors.h"

#include <fstream>
#include <system_error>

#ifdef _WIN32
#include <process.h>
#define getpid _getpid
#else
#include <unistd.h>
#endif

namespace command {
namespace {

namespace fs = std::filesystem;

/// Without a slash at the end, which would hide the name. Where that is a link, what it leads to.
fs::path named(const std::string& path) {
  fs::path whole = fs::path(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  std::error_code failed;
  if (!fs::is_symlink(whole, failed)) return whole;
  const fs::path target = fs::weakly_canonical(whole, failed);
  return failed ? whole : target;
}

}  // namespace

StagedOutput::StagedOutput(const std::string& option, const std::string& path, Kind kind)
    : m_option(option), m_final(named(path)), m_kind(kind) {
  requirePlace(kind);
  const std::string mark = ".part-" + std::to_string(getpid());
  m_staged = m_final.parent_path() / ("." + m_final.stem().string() + mark + m_final.extension().string());
  make(kind);
}

StagedOutput::~StagedOutput() {
  std::error_code ignored;
  fs::remove_all(m_staged, ignored);
}

void StagedOutput::requirePlace(Kind kind) const {
  std::error_code failed;
  const fs::path parent = m_final.has_parent_path() ? m_final.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, failed)) {
    throw InputError(m_option + ": must be in a folder that exists, and " + parent.string() + " does not");
  }
  const bool isFolder = fs::is_directory(m_final, failed);
  if (kind == Kind::file && isFolder) throw InputError(m_option + ": must be a file, not a folder");
  if (kind == Kind::file && fs::exists(m_final, failed) && !fs::is_regular_file(m_final, failed)) {
    throw InputError(m_option + ": must be a file, not a device or a pipe, which would be replaced by one");
  }
  if (kind == Kind::file || !fs::exists(m_final, failed)) return;
  if (!isFolder) throw InputError(m_option + ": must be a folder, not a file");
  if (!fs::is_empty(m_final, failed)) {
    throw InputError(m_option + ": must be a new or an empty folder, and this one has files in it");
  }
  if (fs::equivalent(m_final, fs::current_path(failed), failed)) {
    throw InputError(m_option + ": must not be the folder that the command runs in, which it would take the place of");
  }
}

void StagedOutput::make(Kind kind) const {
  std::error_code failed;
  const bool made = kind == Kind::folder ? fs::create_directory(m_staged, failed)
                                         : static_cast<bool>(std::ofstream(m_staged, std::ios::binary));
  if (!made) throw InputError(m_option + ": must be in a folder that can be written to");
}

void StagedOutput::commit() {
  std::error_code failed;
  if (m_kind == Kind::folder) fs::remove(m_final, failed);  // an empty one
  fs::rename(m_staged, m_final, failed);
  if (failed) throw RunError(m_option + ": could not be written (" + failed.message() + ")");
}

}  // namespace command
