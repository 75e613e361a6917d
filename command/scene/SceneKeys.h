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
     "duration_s", "implicit", "solver", "quality", "cloths", "colliders", "figures", "water", "drops", "camera"}};

inline const KeyTable solver{"solver", {"small_steps", "stiffness_n_m", "guard"}};
inline const KeyTable guard{"guard", {"thickness_m", "self", "others", "every", "friction", "bodies", "untangle"}};

inline const KeyTable cloth{"cloth",
                            {"name",
                             "patch",
                             "obj",
                             "garment",
                             "fabric",
                             "pins",
                             "initial_saturation",
                             "wet_regions",
                             "water_pace",
                             "friction",
                             "damping",
                             "margin_m",
                             "collisions",
                             "self_collision",
                             "clusters",
                             "twist",
                             "motion",
                             "spring_stiffness_n_m",
                             "bending_stiffness_n_m",
                             "spring_damping_n_s_m",
                             "effects"}};

inline const KeyTable patch{"patch",
                            {"columns", "rows", "origin_m", "edge_u_m", "edge_v_m", "mechanical_stiffness",
                             "shear_stiffness", "flexion_stiffness"}};

inline const KeyTable fabric{
    "fabric",
    {"preset", "name", "capacity_kg_per_kg", "time_constant_s", "areal_density_kg_m2", "colour", "roughness"}};

inline const KeyTable waterPace{"waterPace", {"every_substeps", "longest_step_s", "mass_tolerance"}};

inline const KeyTable obj{"obj", {"file", "scale", "rotation_deg", "translation_m"}};

inline const KeyTable pins{"pins", {"corners", "edges", "nodes", "box", "sphere", "group"}};

inline const KeyTable wetRegion{"wetRegion", {"box", "sphere", "saturation"}};

inline const KeyTable twist{"twist", {"edge", "turns_per_s", "turns", "approach_m", "let_go_s"}};

inline const KeyTable motion{"motion", {"times_s", "offsets_m"}};

inline const KeyTable water{"water", {"level_m", "density_kg_m3"}};

inline const KeyTable drops{
    "drops", {"wind_m_s", "drop_mass_kg", "most", "longest_flight_s", "film_kg_m2", "film_cell_m", "pours", "glasses"}};

inline const KeyTable pour{"pour",
                           {"position_m", "velocity_m_s", "flow_kg_s", "drop_diameter_m", "mouth_radius_m",
                            "half_angle_deg", "start_s", "stop_s", "motion"}};

inline const KeyTable glass{"glass", {"collider", "water_kg", "drop_diameter_m"}};

inline const KeyTable exposureBelow{"exposureBelow", {"below_m"}};

inline const KeyTable gust{"gust", {"mean_m_s", "amplitude_m_s", "period_s"}};

inline const KeyTable collider{"collider", {"plane", "box", "sphere", "capsule", "cylinder", "hull", "mesh", "motion"}};

inline const KeyTable plane{"plane", {"normal", "offset_m"}};

inline const KeyTable box{"box", {"centre_m", "half_extents_m"}};

inline const KeyTable sphere{"sphere", {"centre_m", "radius_m"}};

inline const KeyTable capsule{"capsule", {"from_m", "to_m", "radius_m"}};

inline const KeyTable cylinder{"cylinder", {"from_m", "to_m", "radius_m"}};

inline const KeyTable hull{"hull", {"points_m", "obj"}};

inline const KeyTable rigidMotion{"rigidMotion", {"times_s", "offsets_m", "rotations_deg", "about_m"}};

inline const KeyTable figure{
    "figure", {"name", "motion", "scale", "rotation_deg", "translation_m", "parts", "bone_radius_m", "path"}};

inline const KeyTable parts{"parts", {"$schema", "description", "parts"}};

inline const KeyTable part{"part", {"joint", "spheres"}};

inline const KeyTable garment{"garment",
                              {"file", "panels", "seams", "fabrics", "sewing_s", "settling_s", "flexion_stiffness"}};

inline const KeyTable pattern{"pattern", {"$schema", "description", "panels", "seams"}};

inline const KeyTable panel{"panel", {"name", "patch", "obj"}};

inline const KeyTable seam{"seam", {"first", "second"}};

inline const KeyTable seamSide{"seamSide", {"panel", "line", "nodes", "reversed"}};

inline const KeyTable panelFabric{"panelFabric", {"panel", "fabric"}};

inline const KeyTable camera{"camera", {"direction", "field_of_view_deg"}};

/// But for those of effects, which stand in the catalogue.
inline const std::vector<const KeyTable*> all{
    &scene,         &solver,  &guard,    &waterPace, &obj,         &cloth,     &patch, &fabric, &pins,
    &exposureBelow, &gust,    &twist,    &motion,    &water,       &collider,  &plane, &box,    &sphere,
    &camera,        &capsule, &cylinder, &hull,      &rigidMotion, &figure,    &parts, &part,   &garment,
    &pattern,       &panel,   &seam,     &seamSide,  &panelFabric, &wetRegion, &drops, &pour,   &glass};

}  // namespace keys
}  // namespace command
