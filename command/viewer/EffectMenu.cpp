// SPDX-License-Identifier: Zlib
#include "command/viewer/EffectMenu.h"

#include "command/scene/ReadParameters.h"

namespace viewer {
namespace {

template <class E>
OfferedEffect offer(const char* key, typename E::Parameters parameters = {}) {
  return {key, command::addEffect<E>(std::move(parameters))};
}

}  // namespace

std::vector<OfferedEffect> effectMenu(const command::Scene& scene) {
  wetcloth::Rain::Parameters rain;
  rain.direction = -scene.up();
  return {offer<wetcloth::HookeSprings>("hooke_springs"),
          offer<wetcloth::Absorption>("absorption"),
          offer<wetcloth::Immersion>("immersion"),
          offer<wetcloth::Rain>("rain", rain),
          {"splash", {}},
          {"contact_wetting", {}},
          offer<wetcloth::Diffusion>("diffusion"),
          offer<wetcloth::Seepage>("seepage"),
          offer<wetcloth::Dripping>("dripping"),
          offer<wetcloth::Drying>("drying"),
          offer<wetcloth::WetStiffness>("wet_stiffness"),
          offer<wetcloth::Swelling>("swelling"),
          offer<wetcloth::Wind>("wind"),
          offer<wetcloth::WaterDrag>("water_drag"),
          offer<wetcloth::Cling>("cling"),
          offer<wetcloth::WetFriction>("wet_friction"),
          offer<wetcloth::CollisionAudit>("collision_audit")};
}

}  // namespace viewer
