#pragma once

#include "../runner/Plot.h"
#include "Study.h"

namespace accuracy {

/// Error against time per node and simulated second, both logarithmic, labelled by setting; the front as a line below.
runner::Plot plotOf(const Study& study);

}  // namespace accuracy
