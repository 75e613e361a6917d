// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <string>
#include <utility>
#include <vector>

namespace accuracy {

inline constexpr double pi = 3.14159265358979323846;

/// Absorption: forward Euler, RK4 and the exact law, under an exposure that changes in time.
std::vector<Study> studyAbsorption(const Effort& effort, const TellProgress& tell);
/// Diffusion: explicit, factored, conjugate gradients; the step and the mesh.
std::vector<Study> studyDiffusion(const Effort& effort, const TellProgress& tell);
/// Splitting of the effects in a step: Lie's against Strang's.
std::vector<Study> studySplitting(const Effort& effort, const TellProgress& tell);
/// Wind: explicit and semi-implicit, linear and quadratic; on a falling sheet and on a flag.
std::vector<Study> studyWind(const Effort& effort, const TellProgress& tell);
/// The cloth itself: how far it sags, how it swings, by Bullet's links and springs and by HookeSprings.
std::vector<Study> studyCloth(const Effort& effort, const TellProgress& tell);
/// How often water moves, and when masses follow, on cloth that soaks.
std::vector<Study> studyPace(const Effort& effort, const TellProgress& tell);
/// Fineness of the mesh, for wind, wicking and a fall.
std::vector<Study> studyMesh(const Effort& effort, const TellProgress& tell);
/// The collision checks on real queries with exact answers.
std::vector<Study> studyCollision(const Effort& effort, const TellProgress& tell);
/// The guard of ClothSolver: how far ahead it looks and how thick layers are, in a heap and a wrung towel.
std::vector<Study> studyGuard(const Effort& effort, const TellProgress& tell);
/// What a law costs that is nearer to what was measured: water that rises in a strip.
std::vector<Study> studyMeasurement(const Effort& effort, const TellProgress& tell);
/// The paper's own choices against physics.
std::vector<Study> studyPaper(const Effort& effort, const TellProgress& tell);

using CarryOutStudies = std::vector<Study> (*)(const Effort& effort, const TellProgress& tell);

/// By the names that the command knows them by, in its order.
const std::vector<std::pair<std::string, CarryOutStudies>>& studyNames();

}  // namespace accuracy
