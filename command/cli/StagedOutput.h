// SPDX-License-Identifier: Zlib
#pragma once

#include <filesystem>
#include <string>

namespace command {

/// A file or folder that is made beside where it belongs and moved there when it is complete, so that nothing
/// unfinished ever has the final name. What was not moved is removed.
class StagedOutput {
 public:
  enum class Kind { file, folder };

  /// A file that is there already will be replaced, where the path is a link the one that it leads to; a folder must be
  /// new or empty. A device or a pipe is refused.
  /// @param option  as the user wrote it, such as "wetcloth: --out = \"x.html\"", for messages
  /// Throws InputError when it cannot be made there.
  StagedOutput(const std::string& option, const std::string& path, Kind kind);
  ~StagedOutput();
  StagedOutput(const StagedOutput&) = delete;
  StagedOutput& operator=(const StagedOutput&) = delete;

  /// Where to write for now. A folder is there; a file is empty. Its suffix is the final one's.
  std::string path() const { return m_staged.string(); }
  /// Moves it to where it belongs. Throws RunError when that fails.
  void commit();

 private:
  void requirePlace(Kind kind) const;
  void make(Kind kind) const;

  std::string m_option;
  std::filesystem::path m_final;
  std::filesystem::path m_staged;
  Kind m_kind;
};

}  // namespace command
