// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"
#include "command/pictures/View.h"

#include <nlohmann/json.hpp>

namespace pictures {

/// The picture that a page's first view is fitted to; the page steps back when its own is narrower.
constexpr float pageAspect = 1.25F;

// What the scripts of a page (page/) are told.
nlohmann::json pageJson(const Scenery& scenery);
nlohmann::json pageJson(const View& view);
nlohmann::json pageJson(const ClothShape& shape);

/// The shaders of the pictures, by the names that page/renderer.js knows them by.
nlohmann::json pageShaders();

}  // namespace pictures
