#include "EffectReaders.h"

#include "ReadParameters.h"

namespace runner {

using wetcloth::HookeSprings;

AddEffect readHookeSprings(JsonCursor cursor, int) {
  cursor.expectObject(keys::hookeSprings);
  HookeSprings::Parameters parameters;
  readNumber(cursor, "stiffness_n_m", Range::positive(), parameters.stiffness);
  readNumber(cursor, "bending_stiffness_n_m", Range::notNegative(), parameters.bendingStiffness);
  if (const auto iterations = cursor.find("iterations")) parameters.iterations = iterations->integer(1, 10000);
  return addEffect<HookeSprings>(parameters);
}

}  // namespace runner
