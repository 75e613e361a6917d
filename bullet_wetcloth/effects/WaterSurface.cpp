// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WaterSurface.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/numerics/Direction.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kWaterDensity = 1000;

}  // namespace

void requireValid(const char* prefix, const WaterSurface& surface) {
  const std::string name = prefix;
  requireFinite(name + ".normal", surface.normal);
  if (directionOf(surface.normal).isZero()) reject(name + ".normal", "must not be of length 0");
  requireFinite(name + ".offset", surface.offset);
  requirePositive(name + ".density", surface.density);
  requireFinite(name + ".velocity", surface.velocity);
}

WaterSurface normalized(const WaterSurface& surface) {
  WaterSurface unit = surface;
  unit.normal = directionOf(surface.normal);
  unit.offset = surface.offset / lengthOf(surface.normal);
  return unit;
}

std::optional<WaterSurface> surfaceFor(const std::optional<WaterSurface>& own, const btSoftBody& body) {
  if (own) return normalized(*own);
  const btSoftBodyWorldInfo& info = *body.m_worldInfo;
  if (directionOf(info.water_normal).isZero()) return std::nullopt;
  WaterSurface surface;
  surface.normal = info.water_normal;
  surface.offset = static_cast<double>(info.water_offset);
  surface.density = info.water_density > 0 ? static_cast<double>(info.water_density) : kWaterDensity;
  return normalized(surface);
}

void requireSurface(const char* prefix, const std::optional<WaterSurface>& own, const btSoftBody& body) {
  if (!surfaceFor(own, body)) {
    reject(prefix, "is not set, and btSoftBodyWorldInfo::water_normal is of length 0: there is no water");
  }
}

void WaterSurface::transferState(StateArchive& archive) { archive.value(normal, offset, density, velocity); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
