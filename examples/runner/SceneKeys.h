#pragma once

#include <string>
#include <vector>

namespace runner {

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
     "duration_s", "implicit", "cloths", "colliders", "water", "camera"}};

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

inline const KeyTable effects{"effects", {"absorption", "wind", "hooke_springs", "collision_audit"}};

inline const KeyTable absorption{
    "absorption", {"mode", "exposure", "law", "water_velocity_m_s", "conserves_momentum", "ramp_duration_s"}};

inline const KeyTable exposureBelow{"exposureBelow", {"below_m"}};

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
    &scene,        &cloth, &patch,  &fabric, &pins,           &effects,  &absorption, &exposureBelow, &wind,   &gust,
    &hookeSprings, &twist, &motion, &water,  &collisionAudit, &collider, &plane,      &box,           &sphere, &camera};

}  // namespace keys
}  // namespace runner
