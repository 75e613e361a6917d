// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::Diffusion;
using wetcloth::Seepage;

AddEffect readDiffusion(const JsonCursor& cursor, const EffectContext&) {
  using Method = Diffusion::Method;
  static const std::vector<std::pair<std::string, Method>> methods{{"factored", Method::factored},
                                                                   {"explicit_substeps", Method::explicitSubsteps},
                                                                   {"conjugate_gradients", Method::conjugateGradients}};
  Diffusion::Parameters parameters;
  readNumber(cursor, "warp_diffusivity_m2_s", Range::positive(), parameters.warpDiffusivity);
  readNumber(cursor, "weft_diffusivity_m2_s", Range::positive(), parameters.weftDiffusivity);
  readNumber(cursor, "exponent", Range{0, 100, true, "in [0, 100]"}, parameters.exponent);
  readDirection(cursor, "warp", parameters.warp);
  if (const auto method = cursor.find("method")) parameters.method = method->choice(methods);
  readNumber(cursor, "tolerance", Range{0, 1, false, "in (0, 1)", false}, parameters.tolerance);
  return addEffect<Diffusion>(parameters);
}

EffectEntry diffusion() {
  EffectEntry entry;
  entry.key = "diffusion";
  entry.about = "`method`: `factored`, `explicit_substeps`, `conjugate_gradients`; `tolerance` is of the last";
  entry.keys = {"diffusion",
                {"warp_diffusivity_m2_s", "weft_diffusivity_m2_s", "exponent", "warp", "method", "tolerance"}};
  entry.read = readDiffusion;
  entry.byDefault = addDefault<Diffusion>;
  entry.needs.faces = true;
  entry.water = WaterRole::moves;
  return entry;
}

AddEffect readSeepage(const JsonCursor& cursor, const EffectContext&) {
  Seepage::Parameters parameters;
  readNumber(cursor, "speed_m_s", Range::notNegative(), parameters.speed);
  readNumber(cursor, "exponent", Range{1, 100, true, "in [1, 100]"}, parameters.exponent);
  return addEffect<Seepage>(parameters);
}

EffectEntry seepage() {
  EffectEntry entry;
  entry.key = "seepage";
  entry.about = "down along the cloth, under gravity";
  entry.keys = {"seepage", {"speed_m_s", "exponent"}};
  entry.read = readSeepage;
  entry.byDefault = addDefault<Seepage>;
  entry.needs.faces = true;
  entry.water = WaterRole::moves;
  return entry;
}

}  // namespace

EffectCatalogue transportEffects() { return {diffusion(), seepage()}; }

}  // namespace command
