// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"
#include "command/plot/Plot.h"

namespace accuracy {

/// Error against time per node and simulated second, both logarithmic, labelled by setting; the front as a line below.
command::Plot plotOf(const Study& study);

}  // namespace accuracy
