// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"

#include <LinearMath/btScalar.h>

// Bullet's float32 and float64 builds share every symbol name, so a program that mixes them links cleanly and
// crashes. One inline namespace per precision turns that mistake into a link error for our part.
#ifdef BT_USE_DOUBLE_PRECISION
#define WETCLOTH_PRECISION float64
#else
#define WETCLOTH_PRECISION float32
#endif
