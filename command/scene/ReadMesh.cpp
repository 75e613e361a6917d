// SPDX-License-Identifier: Zlib
#include "command/scene/ReadMesh.h"

#include "command/scene/ReadParameters.h"

#include <filesystem>
#include <stdexcept>

namespace command {
namespace {

TriangleMesh readMeshFile(const JsonCursor& name, const Placement& placement) {
  try {
    return readObj(fileBeside(name), placement);
  } catch (const std::invalid_argument& error) {
    name.complain(error.what());
  }
}

}  // namespace

Placement readPlacement(const JsonCursor& cursor) {
  Placement placement;
  readNumber(cursor, "scale", Range::positive(), placement.scale);
  if (const auto rotation = cursor.find("rotation_deg")) placement.rotation = rotation->triple();
  if (const auto translation = cursor.find("translation_m")) placement.translation = translation->triple();
  return placement;
}

TriangleMesh readMesh(JsonCursor cursor) {
  if (cursor.isText()) return readMeshFile(cursor, {});
  if (!cursor.isObject()) cursor.reject("the name of a file, or an object with a \"file\"");
  cursor.expectObject(keys::obj);
  return readMeshFile(cursor.at("file"), readPlacement(cursor));
}

std::string fileBeside(const JsonCursor& name) {
  const std::string text = name.text();
  if (text.empty() || text.find('\0') != std::string::npos) name.reject("the name of a file");
  return (std::filesystem::path(name.file()).parent_path() / text).string();
}

}  // namespace command
