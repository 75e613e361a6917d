// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include <optional>
#include <string>

namespace command {

/// "the cloth blew up in step 7 (t = 0.1 s): /cloths/0: node 3 ...; try more substeps ...": which node of a scene,
/// when, and what usually helps (findBlowUp()); none while all cloths are sound. Whatever steps a scene asks after each
/// step.
/// @param otherPush  of what pushes the cloth and is not in the scene [m/s]
std::optional<std::string> describeBlowUp(const SceneWorld& world, double otherPush = 0);

/// Throws RunError with the scene's file and that, if a cloth has blown up.
void requireSound(const SceneWorld& world);

/// The same of a cloth that is in no scene: throws RunError with what findBlowUp() found, if it found something.
/// @param time    since the start [s]
/// @param remedy  what to try, "; try ..."
void requireSound(const std::optional<std::string>& blowUp, double time, const std::string& remedy = "");

}  // namespace command
