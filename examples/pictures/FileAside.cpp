#include "FileAside.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace pictures {
namespace {

std::string pathAside(const std::filesystem::path& file) {
  std::random_device random;
  const std::string name =
      "." + file.stem().string() + "." + std::to_string(random() % 1000000) + ".part" + file.extension().string();
  return (file.parent_path() / name).string();
}

}  // namespace

FileAside::FileAside(std::string file) : m_file(std::move(file)), m_path(pathAside(m_file)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(m_file, ignored)) throw std::runtime_error("is a folder");
  const std::filesystem::path folder = std::filesystem::path(m_file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
    throw std::runtime_error("there is no folder " + folder.string());
  }
  if (!std::ofstream(m_path, std::ios::binary)) {
    throw std::runtime_error("the folder " + (folder.empty() ? "." : folder.string()) + " cannot be written to");
  }
}

FileAside::~FileAside() {
  std::error_code ignored;
  if (!m_path.empty()) std::filesystem::remove(m_path, ignored);
}

void FileAside::finish() {
  std::error_code failed;
  std::filesystem::rename(m_path, m_file, failed);
  if (failed) throw std::runtime_error(failed.message());
  m_path.clear();
}

}  // namespace pictures
