// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"

#include "bullet_wetcloth/bullet_wetcloth.h"

namespace command {

/// The name of a preset, or an object that describes a fabric.
wetcloth::Fabric readFabric(JsonCursor cursor);

}  // namespace command
