// SPDX-License-Identifier: Zlib
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace fuzz {

/// Bytes as a file that a reader can open by name; it lives in memory alone.
class Input {
 public:
  explicit Input(const std::string& bytes) : m_descriptor(memfd_create("input", 0)) {
    if (m_descriptor < 0 || write(m_descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("no file in memory could be made");
    }
  }
  ~Input() { close(m_descriptor); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(m_descriptor); }

 private:
  int m_descriptor;
};

/// The same by a name of this ending, for a reader that goes by it.
class NamedInput {
 public:
  NamedInput(const std::string& bytes, const std::string& ending)
      : m_bytes(bytes),
        m_path(std::filesystem::temp_directory_path() / ("wetcloth-fuzz-" + std::to_string(getpid()) + ending)) {
    std::filesystem::remove(m_path);
    std::filesystem::create_symlink(m_bytes.path(), m_path);
  }
  ~NamedInput() {
    std::error_code ignored;
    std::filesystem::remove(m_path, ignored);
  }
  NamedInput(const NamedInput&) = delete;
  NamedInput& operator=(const NamedInput&) = delete;

  std::string path() const { return m_path.string(); }

 private:
  Input m_bytes;
  std::filesystem::path m_path;
};

/// A reader takes its input or refuses it, with one line that says why; everything else is a fault.
/// @tparam Refusal  the exception that refuses
template <class Refusal, class Read>
void takesOrRefuses(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    const std::string message = refusal.what();
    if (message.empty() || message.find('\n') != std::string::npos) throw std::logic_error("not one line: " + message);
  }
}

}  // namespace fuzz
