// SPDX-License-Identifier: Zlib
#pragma once

namespace pictures {

/// What the colours of a cloth mean.
enum class Colouring { fabric, saturation, stretch, speed };

}  // namespace pictures
