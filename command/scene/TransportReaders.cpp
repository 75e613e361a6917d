// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::Diffusion;
using wetcloth::Seepage;

AddEffect readDiffusion(JsonCursor cursor, const EffectContext&) {
  using Method = Diffusion::Method;
  static const std::vector<std::pair<std::string, Method>> methods{{"factored", Method::factored},
                                                                   {"explicit_substeps", Method::explicitSubsteps},
                                                                   {"conjugate_gradients", Method::conjugateGradients}};
  cursor.expectObject(keys::diffusion);
  Diffusion::Parameters parameters;
  readNumber(cursor, "warp_diffusivity_m2_s", Range::positive(), parameters.warpDiffusivity);
  readNumber(cursor, "weft_diffusivity_m2_s", Range::positive(), parameters.weftDiffusivity);
  readNumber(cursor, "exponent", Range{0, 100, true, "in [0, 100]"}, parameters.exponent);
  readDirection(cursor, "warp", parameters.warp);
  if (const auto method = cursor.find("method")) parameters.method = method->choice(methods);
  readNumber(cursor, "tolerance", Range{0, 1, false, "in (0, 1)", false}, parameters.tolerance);
  return addEffect<Diffusion>(parameters);
}

AddEffect readSeepage(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::seepage);
  Seepage::Parameters parameters;
  readNumber(cursor, "speed_m_s", Range::notNegative(), parameters.speed);
  readNumber(cursor, "exponent", Range{1, 100, true, "in [1, 100]"}, parameters.exponent);
  return addEffect<Seepage>(parameters);
}

}  // namespace command
