// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::Diffusion;
using wetcloth::Seepage;

const KeyTable kDiffusionKeys = {
    "diffusion", {"warp_diffusivity_m2_s", "weft_diffusivity_m2_s", "exponent", "warp", "method", "tolerance"}};

Diffusion::Parameters diffusionOf(const JsonCursor& cursor) {
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
  return parameters;
}

AddEffect readDiffusion(const JsonCursor& cursor, const EffectContext&) {
  return addEffect<Diffusion>(diffusionOf(cursor));
}

EffectEntry diffusion() {
  EffectEntry entry;
  entry.key = "diffusion";
  entry.about = "`method`: `factored`, `explicit_substeps`, `conjugate_gradients`; `tolerance` is of the last";
  entry.keys = kDiffusionKeys;
  entry.read = readDiffusion;
  entry.byDefault = addDefault<Diffusion>;
  entry.needs.faces = true;
  entry.water = WaterRole::moves;
  return entry;
}

Seepage::Parameters inBalance(const JsonCursor& height, const JsonCursor& effects) {
  auto diffusion = effects.find("diffusion");
  if (!diffusion) height.complain("there is no \"diffusion\" to be in balance with");
  diffusion->expectObject(kDiffusionKeys);
  return wetcloth::seepageInBalance(diffusionOf(*diffusion), height.number(Range::positive()));
}

AddEffect readSeepage(const JsonCursor& cursor, const EffectContext& context) {
  if (const auto height = cursor.find("height_m")) {
    if (cursor.find("speed_m_s") || cursor.find("exponent")) height->complain("it stands for speed_m_s and exponent");
    return addEffect<Seepage>(inBalance(*height, *context.effects));
  }
  Seepage::Parameters parameters;
  readNumber(cursor, "speed_m_s", Range::notNegative(), parameters.speed);
  readNumber(cursor, "exponent", Range{1, 100, true, "in [1, 100]"}, parameters.exponent);
  return addEffect<Seepage>(parameters);
}

EffectEntry seepage() {
  EffectEntry entry;
  entry.key = "seepage";
  entry.about = "down along the cloth, under gravity; `height_m` instead of both: in balance with `diffusion` over it";
  entry.keys = {"seepage", {"speed_m_s", "exponent", "height_m"}};
  entry.read = readSeepage;
  entry.byDefault = addDefault<Seepage>;
  entry.needs.faces = true;
  entry.water = WaterRole::moves;
  return entry;
}

}  // namespace

EffectCatalogue transportEffects() { return {diffusion(), seepage()}; }

}  // namespace command
