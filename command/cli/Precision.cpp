// SPDX-License-Identifier: Zlib
#include "command/cli/Precision.h"

namespace command {

const NamedValues<Precision>& precisionNames() {
  static const NamedValues<Precision> names{{"float32", Precision::float32}, {"float64", Precision::float64}};
  return names;
}

std::string nameOf(Precision precision) { return nameIn(precisionNames(), precision); }

}  // namespace command
