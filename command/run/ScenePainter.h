// SPDX-License-Identifier: Zlib
#pragma once

#include "command/run/FrameShot.h"
#include "command/run/Painting.h"
#include "command/scene/Scene.h"

#include <array>
#include <vector>

namespace command {

/// Node numbers at the corners of each face.
std::vector<std::array<int, 3>> facesOf(const btSoftBody& body);

void paintCloth(Painting& painting, const Camera& camera, const btSoftBody& body, const FrameShot::Cloth& cloth);

/// The rod or line that a cloth hangs from, when its pinned nodes lie on one line.
/// @param ground reached down to by an upright rod; may be null
void paintRod(Painting& painting, const Camera& camera, const btSoftBody& body, const FrameShot::Cloth& cloth,
              const Plane* ground);

/// Where it is at this time [s]; planes are painted as the ground.
void paintCollider(Painting& painting, const Camera& camera, const Collider& collider, double time);

/// The surface of the scene's water, as far as the cloths reach and somewhat farther.
void paintWater(Painting& painting, const Camera& camera, const Scene& scene, const FrameShot& shot);

/// The flat pieces that a collider is painted with at this time [s], counter-clockwise from outside; none for a plane.
std::vector<std::vector<btVector3>> piecesOf(const Collider& collider, double time);

}  // namespace command
