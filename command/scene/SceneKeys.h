// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace command {

/// The keys that one kind of object in a scene may have. The reader refuses all others, and a test holds the
/// tables against the definitions of the same names in examples/scenes/scene.schema.json.
struct KeyTable {
  std::string name;
  std::vector<std::string> keys;
};

namespace keys {

inline const KeyTable scene{
    "scene",
    {"$schema", "name", "description", "world", "precision", "gravity_m_s2", "step_s", "substeps", "iterations",
     "duration_s", "implicit", "quality", "cloths", "colliders", "water", "camera"}};

inline const KeyTable cloth{"cloth",
                            {"name", "patch", "obj", "fabric", "pins", "initial_saturation", "friction", "damping",
                             "margin_m", "collisions", "self_collision", "clusters", "twist", "motion",
                             "spring_stiffness_n_m", "bending_stiffness_n_m", "spring_damping_n_s_m", "effects"}};

inline const KeyTable patch{"patch",
                            {"columns", "rows", "origin_m", "edge_u_m", "edge_v_m", "mechanical_stiffness",
                             "shear_stiffness", "flexion_stiffness"}};

inline const KeyTable fabric{
    "fabric",
    {"preset", "name", "capacity_kg_per_kg", "time_constant_s", "areal_density_kg_m2", "colour", "roughness"}};

inline const KeyTable pins{"pins", {"corners", "edges", "nodes"}};

inline const KeyTable twist{"twist", {"edge", "turns_per_s", "turns"}};

inline const KeyTable motion{"motion", {"times_s", "offsets_m"}};

inline const KeyTable water{"water", {"level_m", "density_kg_m3"}};

inline const KeyTable effects{
    "effects",
    {"absorption", "immersion", "rain", "splash", "contact_wetting", "diffusion", "seepage", "dripping", "drying",
     "wet_stiffness", "swelling", "wind", "water_drag", "cling", "hooke_springs", "wet_friction", "collision_audit"}};

inline const KeyTable absorption{
    "absorption", {"mode", "exposure", "law", "water_velocity_m_s", "conserves_momentum", "ramp_duration_s"}};

inline const KeyTable exposureBelow{"exposureBelow", {"below_m"}};

inline const KeyTable immersion{"immersion", {}};

inline const KeyTable rain{"rain", {"direction", "flux_kg_m2_s", "speed_m_s", "self_shelter"}};

inline const KeyTable splash{"splash", {"sphere", "cone", "velocity_m_s", "flux_kg_m2_s"}};

inline const KeyTable streamSphere{"streamSphere", {"centre_m", "radius_m"}};

inline const KeyTable streamCone{"streamCone", {"apex_m", "half_angle_deg", "reach_m"}};

inline const KeyTable contactWetting{"contactWetting", {"films", "cloths", "rate_kg_m2_s"}};

inline const KeyTable film{"film", {"collider", "water_kg"}};

inline const KeyTable diffusion{
    "diffusion", {"warp_diffusivity_m2_s", "weft_diffusivity_m2_s", "exponent", "warp", "method", "tolerance"}};

inline const KeyTable seepage{"seepage", {"speed_m_s", "exponent"}};

inline const KeyTable dripping{"dripping",
                               {"holding_saturation", "time_constant_s", "drop_mass_kg", "slope_tolerance"}};

inline const KeyTable drying{"drying",
                             {"temperature_c", "relative_humidity", "velocity_m_s", "gust", "self_cooling",
                              "critical_saturation", "sides", "exposure"}};

inline const KeyTable wetStiffness{"wetStiffness",
                                   {"wet_stretch", "wet_bending", "dry_damping_1_s", "wet_damping_1_s"}};

inline const KeyTable swelling{"swelling", {"saturated_strain"}};

inline const KeyTable waterDrag{"waterDrag", {"drag_coefficient", "skin_friction", "fibre_density_kg_m3"}};

inline const KeyTable cling{
    "cling", {"adhesion_pa", "shear_strength_pa", "minimum_saturation", "peak_saturation", "flooded_share"}};

inline const KeyTable wetFriction{"wetFriction", {"wet_factor", "peak_saturation", "flooded_factor"}};

inline const KeyTable wind{"wind",
                           {"mode", "velocity_m_s", "gust", "law", "integration", "air_density_kg_m3",
                            "drag_coefficient", "skin_friction", "linear_drag_n_s_m3", "paper_force_n"}};

inline const KeyTable gust{"gust", {"mean_m_s", "amplitude_m_s", "period_s"}};

inline const KeyTable hookeSprings{"hookeSprings", {"stiffness_n_m", "bending_stiffness_n_m", "iterations"}};

inline const KeyTable collisionAudit{"collisionAudit", {"self", "others", "tier"}};

inline const KeyTable collider{"collider", {"plane", "box", "sphere"}};

inline const KeyTable plane{"plane", {"normal", "offset_m"}};

inline const KeyTable box{"box", {"centre_m", "half_extents_m"}};

inline const KeyTable sphere{"sphere", {"centre_m", "radius_m"}};

inline const KeyTable camera{"camera", {"direction", "field_of_view_deg"}};

inline const std::vector<const KeyTable*> all{
    &scene,  &cloth,        &patch,        &fabric,         &pins,   &effects,     &absorption,     &exposureBelow,
    &wind,   &gust,         &hookeSprings, &twist,          &motion, &water,       &immersion,      &rain,
    &splash, &streamSphere, &streamCone,   &contactWetting, &film,   &diffusion,   &seepage,        &dripping,
    &drying, &wetStiffness, &swelling,     &waterDrag,      &cling,  &wetFriction, &collisionAudit, &collider,
    &plane,  &box,          &sphere,       &camera};

}  // namespace keys
}  // namespace command
