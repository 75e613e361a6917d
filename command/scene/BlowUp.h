// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <optional>
#include <string>

namespace command {

/// How fast things may be and springs may hang, so that what is beyond it by far was made by the solver.
struct MotionBounds {
  double speed;    ///< of the fastest thing that pushes, and of a fall for as long as the run lasts [m/s]
  double substep;  ///< [s]
  double sag = 0;  ///< of a spring that bears all the cloth's weight [m]
};

/// Links shorter than this share of the mean are measured against it, as `wetcloth stability` does.
constexpr double shortLink = 0.1;

/// What of a cloth blew up: "node 7 is not finite", "node 7 moves with 3e+05 m/s", "... its link to node 8 is 40000
/// times as long as at rest"; none while it is sound. The bounds are those of `wetcloth stability`, each taken so wide
/// that a cloth which is only stretched or swept along is not meant:
/// - a node is farther from 0 than `farthest`, or faster than 20 times `speed`;
/// - a link is longer than 10 times its rest length, one substep's way and `sag`, and its ends part or meet by more
/// than
///   its rest length in one substep: a cloth that hangs too long is slow;
/// - or it is longer than 1000 times its rest length and `sag`, however slow.
std::optional<std::string> findBlowUp(const btSoftBody& body, const MotionBounds& bounds);

}  // namespace command
