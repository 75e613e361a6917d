#pragma once

#include <string>

namespace pictures {

/// A file that gets its name when it is whole: until then it is beside it under another name with the same suffix,
/// and it is removed if it never comes to that.
class FileAside {
 public:
  /// Throws std::runtime_error when the folder does not exist or cannot be written to.
  explicit FileAside(std::string file);
  ~FileAside();
  FileAside(const FileAside&) = delete;
  FileAside& operator=(const FileAside&) = delete;

  /// Where to write to meanwhile; an empty file at first.
  const std::string& path() const { return m_path; }
  /// Gives the file its name. Throws std::runtime_error when that fails.
  void finish();

 private:
  std::string m_file;
  std::string m_path;
};

}  // namespace pictures
