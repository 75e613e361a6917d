// SPDX-License-Identifier: Zlib
#include "command/scene/FabricReader.h"

#include "command/scene/ReadParameters.h"

#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

wetcloth::Fabric readPreset(const JsonCursor& cursor) {
  std::vector<std::pair<std::string, wetcloth::Fabric>> presets;
  for (const wetcloth::Fabric& fabric : wetcloth::Fabric::presets()) presets.emplace_back(fabric.name, fabric);
  return cursor.choice(presets);
}

}  // namespace

wetcloth::Fabric readFabric(JsonCursor cursor) {
  if (cursor.isText()) return readPreset(cursor);
  if (!cursor.isObject()) cursor.reject("the name of a fabric, or an object that describes one");
  cursor.expectObject(keys::fabric);
  wetcloth::Fabric fabric;
  if (const auto preset = cursor.find("preset")) {
    fabric = readPreset(*preset);
  } else {
    cursor.at("capacity_kg_per_kg");
    cursor.at("time_constant_s");
    cursor.at("areal_density_kg_m2");
  }
  if (const auto name = cursor.find("name")) fabric.name = name->text();
  readNumber(cursor, "capacity_kg_per_kg", Range::positive(), fabric.capacity);
  readNumber(cursor, "time_constant_s", Range::positive(), fabric.timeConstant);
  readNumber(cursor, "areal_density_kg_m2", Range::positive(), fabric.arealDensity);
  if (const auto colour = cursor.find("colour")) fabric.dryColour = colour->triple(Range::fraction());
  readNumber(cursor, "roughness", Range::fraction(), fabric.dryRoughness);
  return fabric;
}

}  // namespace command
