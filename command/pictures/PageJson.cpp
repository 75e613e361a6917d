// SPDX-License-Identifier: Zlib
#include "command/pictures/PageJson.h"

#include "Embedded.h"

namespace pictures {

nlohmann::json pageJson(const Scenery& scenery) {
  nlohmann::json json{{"title", scenery.title}, {"up", scenery.up}, {"viewDirection", scenery.viewDirection}};
  json["grounds"] = nlohmann::json::array();
  for (const Ground& ground : scenery.grounds) {
    json["grounds"].push_back({{"normal", ground.normal}, {"offset", ground.offset}});
  }
  if (scenery.waterLevel) json["waterLevel"] = *scenery.waterLevel;
  return json;
}

nlohmann::json pageJson(const View& view) {
  return {{"eye", view.eye}, {"target", view.target}, {"fieldOfView", view.fieldOfView}, {"aspect", pageAspect}};
}

nlohmann::json pageJson(const ClothShape& shape) {
  nlohmann::json parts = nlohmann::json::array();
  for (const auto& [look, triangles] : shape.parts) {
    parts.push_back({{"triangles", triangles},
                     {"dryColour", look.dryColour},
                     {"wetColour", look.wetColour},
                     {"roughness", {look.dryRoughness, look.wetRoughness}}});
  }
  return {
      {"name", shape.name}, {"nodes", shape.texture.size()}, {"triangles", shape.triangles.size()}, {"parts", parts}};
}

nlohmann::json pageShaders() {
  return {{"common", embedded::common_glsl},
          {"light", embedded::light_glsl},
          {"backdrop", embedded::backdrop_glsl},
          {"clothLight", embedded::cloth_light_glsl},
          {"casterVertex", embedded::caster_vert_glsl},
          {"casterFragment", embedded::caster_frag_glsl},
          {"clothVertex", embedded::cloth_vert_glsl},
          {"clothFragment", embedded::cloth_frag_glsl},
          {"measuredFragment", embedded::measured_frag_glsl},
          {"solidVertex", embedded::solid_vert_glsl},
          {"solidFragment", embedded::solid_frag_glsl},
          {"groundVertex", embedded::ground_vert_glsl},
          {"groundShaded", embedded::ground_shaded_glsl},
          {"groundOpen", embedded::ground_open_glsl},
          {"groundFragment", embedded::ground_frag_glsl},
          {"waterFragment", embedded::water_frag_glsl},
          {"backdropVertex", embedded::backdrop_vert_glsl},
          {"backdropFragment", embedded::backdrop_frag_glsl}};
}

}  // namespace pictures
