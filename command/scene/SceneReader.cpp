// SPDX-License-Identifier: Zlib
#include "command/scene/SceneReader.h"

#include "command/cli/Errors.h"
#include "command/cli/ProgramFolder.h"
#include "command/scene/ColliderReader.h"
#include "command/scene/DropsReader.h"
#include "command/scene/FabricReader.h"
#include "command/scene/FigureReader.h"
#include "command/scene/GarmentReader.h"
#include "command/scene/JsonCursor.h"
#include "command/scene/PatchReader.h"
#include "command/scene/Quality.h"
#include "command/scene/ReadMesh.h"
#include "command/scene/ReadParameters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace command {
namespace {

using wetcloth::ClothPatch;

std::vector<int> readNodes(const JsonCursor& cursor, int nodes) {
  std::vector<int> indices;
  for (const JsonCursor& element : cursor.elements()) indices.push_back(element.integer(0, nodes - 1));
  return indices;
}

void readPatchPins(const JsonCursor& cursor, ClothPatch& patch) {
  using Corner = ClothPatch::Corner;
  static const std::vector<std::pair<std::string, Corner>> corners{{"bottom_left", Corner::bottomLeft},
                                                                   {"bottom_right", Corner::bottomRight},
                                                                   {"top_left", Corner::topLeft},
                                                                   {"top_right", Corner::topRight}};
  if (const auto list = cursor.find("corners")) {
    for (const JsonCursor& corner : list->elements()) patch.pinnedCorners.push_back(corner.choice(corners));
  }
  if (const auto list = cursor.find("edges")) {
    for (const JsonCursor& edge : list->elements()) patch.pinnedEdges.push_back(edge.choice(edgeNames()));
  }
  if (const auto list = cursor.find("nodes")) patch.pinnedNodes = readNodes(*list, patch.nodeCount());
}

/// Nodes of a mesh are told by the file's vertices, by its groups, or by where they are.
void readMeshPins(const JsonCursor& cursor, const TriangleMesh& mesh, std::vector<int>& pinned) {
  for (const char* key : {"corners", "edges"}) {
    if (const auto found = cursor.find(key)) {
      found->complain("an OBJ has no corners or edges, pin its \"nodes\", a \"group\", or what is in a \"box\"");
    }
  }
  if (const auto list = cursor.find("nodes")) {
    for (const int vertex : readNodes(*list, static_cast<int>(mesh.nodeOfVertex.size()))) {
      pinned.push_back(mesh.nodeOfVertex[static_cast<std::size_t>(vertex)]);
    }
  }
  if (const auto name = cursor.find("group")) {
    if (mesh.groups.empty()) name->complain("the OBJ has no groups, lines \"g name\" or \"o name\" above faces");
    std::vector<std::pair<std::string, std::vector<int>>> groups(mesh.groups.begin(), mesh.groups.end());
    const std::vector<int> nodes = name->choice(groups);
    pinned.insert(pinned.end(), nodes.begin(), nodes.end());
  }
}

void pinWhatIsIn(const JsonCursor& cursor, const Region& region, const ClothScene& cloth, std::vector<int>& pinned) {
  const std::vector<btVector3> positions = cloth.nodePositions();
  const std::size_t before = pinned.size();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (region.holds(positions[i])) pinned.push_back(static_cast<int>(i));
  }
  if (pinned.size() == before) cursor.complain("pins nothing: no node of the cloth begins in it");
}

void readRegionPins(const JsonCursor& cursor, const ClothScene& cloth, std::vector<int>& pinned) {
  if (const auto box = cursor.find("box")) pinWhatIsIn(*box, {readBox(*box)}, cloth, pinned);
  if (const auto sphere = cursor.find("sphere")) pinWhatIsIn(*sphere, {readSphere(*sphere)}, cloth, pinned);
}

/// What of a cloth is wetter or drier at the start than the rest.
std::vector<WetRegion> readWetRegions(const JsonCursor& list) {
  std::vector<WetRegion> regions;
  for (JsonCursor element : list.elements()) {
    element.expectObject(keys::wetRegion);
    const bool isBox = element.exactlyOneOf({"box", "sphere"}) == "box";
    const Region region = isBox ? Region{readBox(element.at("box"))} : Region{readSphere(element.at("sphere"))};
    regions.push_back({region, element.at("saturation").number(Range::fraction())});
  }
  return regions;
}

void readPins(JsonCursor cursor, ClothScene& cloth) {
  cursor.expectObject(keys::pins);
  if (auto* patch = std::get_if<ClothPatch>(&cloth.shape)) {
    if (const auto group = cursor.find("group")) group->complain("a patch has no groups, an OBJ does");
    readPatchPins(cursor, *patch);
    readRegionPins(cursor, cloth, patch->pinnedNodes);
  } else {
    readMeshPins(cursor, std::get<TriangleMesh>(cloth.shape), cloth.pinnedNodes);
    readRegionPins(cursor, cloth, cloth.pinnedNodes);
  }
}

void readSprings(const JsonCursor& cursor, WorldKind world, SpringScene& springs) {
  for (const char* key : {"spring_stiffness_n_m", "bending_stiffness_n_m", "spring_damping_n_s_m"}) {
    const auto found = cursor.find(key);
    if (found && world != WorldKind::deformable) {
      found->complain("only the world \"deformable\" reads it; elsewhere use the effect hooke_springs");
    }
  }
  if (const auto found = cursor.find("spring_stiffness_n_m")) springs.stiffness = found->number(Range::positive());
  if (const auto found = cursor.find("bending_stiffness_n_m")) {
    springs.bendingStiffness = found->number(Range::notNegative());
  }
  readNumber(cursor, "spring_damping_n_s_m", Range::notNegative(), springs.damping);
}

wetcloth::WaterPace readPace(JsonCursor cursor) {
  cursor.expectObject(keys::waterPace);
  wetcloth::WaterPace pace;
  if (const auto every = cursor.find("every_substeps")) pace.everySubsteps = every->integer(1, 1000);
  readNumber(cursor, "longest_step_s", Range::positive(), pace.longestStep);
  readNumber(cursor, "mass_tolerance", Range{0, 0.1, true, "in [0, 0.1]"}, pace.massTolerance);
  return pace;
}

void readDamping(const JsonCursor& cursor, WorldKind world, ClothScene& cloth) {
  const auto found = cursor.find("damping");
  if (!found) return;
  if (world == WorldKind::deformable) found->complain("the world \"deformable\" does not read it");
  cloth.damping = found->number(Range::fraction());
}

/// Bullet's own names, as they stand in btSoftBody::fCollision.
int readCollisionFlags(const JsonCursor& cursor) {
  using Flag = btSoftBody::fCollision;
  static const std::vector<std::pair<std::string, int>> names{
      {"SDF_RS", Flag::SDF_RS},   {"CL_RS", Flag::CL_RS},    {"SDF_RD", Flag::SDF_RD}, {"SDF_RDF", Flag::SDF_RDF},
      {"SDF_RDN", Flag::SDF_RDN}, {"VF_SS", Flag::VF_SS},    {"CL_SS", Flag::CL_SS},   {"CL_SELF", Flag::CL_SELF},
      {"VF_DD", Flag::VF_DD},     {"SDF_MDF", Flag::SDF_MDF}};
  int flags = 0;
  for (const JsonCursor& flag : cursor.elements()) flags |= flag.choice(names);
  return flags;
}

void readCollisions(const JsonCursor& cursor, ClothScene& cloth) {
  if (const auto flags = cursor.find("collisions")) cloth.collisions = readCollisionFlags(*flags);
  if (const auto self = cursor.find("self_collision")) cloth.selfCollision = self->boolean();
  if (const auto clusters = cursor.find("clusters")) cloth.clusters = clusters->integer(0, cloth.nodeCount());
}

TwistScene readTwist(JsonCursor cursor, const ClothScene& cloth) {
  cursor.expectObject(keys::twist);
  const auto* patch = std::get_if<ClothPatch>(&cloth.shape);
  if (!patch) cursor.complain("an OBJ has no edges to turn, a patch does");
  TwistScene twist;
  twist.edge = cursor.at("edge").choice(edgeNames());
  if (std::count(patch->pinnedEdges.begin(), patch->pinnedEdges.end(), twist.edge) == 0) {
    cursor.at("edge").complain("must be one of the pinned edges, /pins/edges");
  }
  readNumber(cursor, "turns_per_s", Range::finite(), twist.turnsPerSecond);
  readNumber(cursor, "turns", Range::notNegative(), twist.turns);
  const bool isAlongU = twist.edge == ClothPatch::Edge::bottom || twist.edge == ClothPatch::Edge::top;
  const double apart = static_cast<double>((isAlongU ? patch->edgeV : patch->edgeU).length());
  const Range approach{0, apart, true, "from 0 to less than the distance to the opposite edge", false};
  readNumber(cursor, "approach_m", approach, twist.approach);
  readNumber(cursor, "let_go_s", Range::notNegative(), twist.letGo);
  return twist;
}

MotionScene readMotion(JsonCursor cursor, const ClothScene& cloth) {
  cursor.expectObject(keys::motion);
  if (!cloth.hasPins()) cursor.complain("moves the cloth's pins, and it has none");
  if (cloth.twist) cursor.complain("must not be there beside twist, which moves pins, too");
  MotionScene motion;
  motion.times = readTimes(cursor.at("times_s"));
  motion.offsets = readForEachTime(cursor.at("offsets_m"), motion.times.size());
  return motion;
}

/// Diagonal of the box round it [m].
double sizeOf(const ClothScene& cloth) {
  const std::vector<btVector3> positions = cloth.nodePositions();
  btVector3 low = positions.front();
  btVector3 high = low;
  for (const btVector3& position : positions) {
    low.setMin(position);
    high.setMax(position);
  }
  return static_cast<double>((high - low).length());
}

/// What is allowed and hardly ever meant.
void hintAt(const JsonCursor& shape, const ClothScene& cloth, std::vector<std::string>& hints) {
  constexpr double large = 20, small = 0.01;  // [m]
  const std::string place = onOneLine(shape.file() + ": " + shape.pointer()) + ": ";
  const auto* mesh = std::get_if<TriangleMesh>(&cloth.shape);
  if (mesh != nullptr && !mesh->remarks.empty()) {
    std::string text;
    for (const std::string& remark : mesh->remarks) text += (text.empty() ? "" : "; ") + remark;
    hints.push_back(place + text);
  }
  const double size = sizeOf(cloth);
  if (size >= small && size <= large) return;
  char text[160];
  std::snprintf(text, sizeof text, "the cloth is %.3g m across: are its lengths metres?%s", size,
                mesh == nullptr ? ""
                : size > large  ? " \"obj\": {\"file\": ..., \"scale\": 0.001} takes millimetres"
                                : " \"obj\": {\"file\": ..., \"scale\": 1000} makes it larger");
  hints.push_back(place + text);
}

ClothScene readCloth(JsonCursor cursor, Scene& scene, const EffectCatalogue& catalogue) {
  cursor.expectObject(keys::cloth);
  ClothScene cloth;
  if (const auto name = cursor.find("name")) cloth.name = name->text();
  cloth.fabric = readFabric(cursor.at("fabric"));
  const std::string kind = cursor.exactlyOneOf({"patch", "obj", "garment"});
  if (kind == "patch") cloth.shape = readPatch(cursor.at(kind));
  if (kind == "obj") cloth.shape = readMesh(cursor.at(kind));
  if (kind == "garment") readGarment(cursor.at(kind), cloth);
  hintAt(cursor.at(kind), cloth, scene.hints);
  if (auto* patch = std::get_if<ClothPatch>(&cloth.shape)) patch->arealDensity = cloth.fabric.arealDensity;
  if (const auto pins = cursor.find("pins")) readPins(*pins, cloth);
  readNumber(cursor, "initial_saturation", Range::fraction(), cloth.initialSaturation);
  if (const auto regions = cursor.find("wet_regions")) cloth.wetRegions = readWetRegions(*regions);
  if (const auto pace = cursor.find("water_pace")) cloth.pace = readPace(*pace);
  readNumber(cursor, "friction", Range::fraction(), cloth.friction);
  readDamping(cursor, scene.world, cloth);
  readNumber(cursor, "margin_m", Range::positive(), cloth.margin);
  cloth.meetsWhatMoves = std::any_of(scene.colliders.begin(), scene.colliders.end(),
                                     [](const Collider& collider) { return collider.motion.has_value(); });
  readCollisions(cursor, cloth);
  if (const auto twist = cursor.find("twist")) cloth.twist = readTwist(*twist, cloth);
  if (const auto motion = cursor.find("motion")) cloth.motion = readMotion(*motion, cloth);
  readSprings(cursor, scene.world, cloth.springs);
  if (const auto effects = cursor.find("effects")) cloth.effects = readEffects(*effects, {scene, cloth}, catalogue);
  return cloth;
}

WaterScene readWater(JsonCursor cursor) {
  cursor.expectObject(keys::water);
  WaterScene water;
  water.level = cursor.at("level_m").number(Range::finite());
  readNumber(cursor, "density_kg_m3", Range::positive(), water.density);
  return water;
}

CameraScene readCamera(JsonCursor cursor) {
  cursor.expectObject(keys::camera);
  CameraScene camera;
  if (const auto direction = cursor.find("direction")) camera.direction = readDirection(*direction).normalized();
  readNumber(cursor, "field_of_view_deg", Range{5, 120, true, "from 5 to 120"}, camera.fieldOfView);
  return camera;
}

wetcloth::ClothSolver::Guard readGuard(JsonCursor cursor) {
  wetcloth::ClothSolver::Guard settings;
  cursor.expectObject(keys::guard);
  readNumber(cursor, "thickness_m", Range::notNegative(), settings.thickness);
  if (const auto self = cursor.find("self")) settings.self = self->boolean();
  if (const auto others = cursor.find("others")) settings.others = others->boolean();
  if (const auto every = cursor.find("every")) settings.every = every->integer(1, 100);
  readNumber(cursor, "friction", Range::notNegative(), settings.friction);
  if (const auto bodies = cursor.find("bodies")) settings.bodies = bodies->boolean();
  if (const auto untangle = cursor.find("untangle")) settings.untangle = untangle->boolean();
  return settings;
}

/// None: Bullet's own.
std::optional<wetcloth::ClothSolver::Parameters> readSolver(JsonCursor cursor) {
  wetcloth::ClothSolver::Parameters parameters;
  if (cursor.isText()) {
    if (cursor.choice(solverNames()) == SolverKind::bullet) return std::nullopt;
    return parameters;
  }
  if (!cursor.isObject()) cursor.reject("\"bullet\", \"wetcloth\", or an object with the numbers of the latter");
  cursor.expectObject(keys::solver);
  if (const auto count = cursor.find("small_steps")) parameters.smallSteps = count->integer(1, 1000);
  readNumber(cursor, "stiffness_n_m", Range::positive(), parameters.stiffness);
  if (const auto settings = cursor.find("guard")) parameters.guard = readGuard(*settings);
  return parameters;
}

Precision precisionAt(const JsonCursor& scene) {
  const auto precision = scene.find("precision");
  return precision ? precision->choice(precisionNames()) : Scene().precision;
}

void readWorld(const JsonCursor& cursor, Scene& scene) {
  scene.world = cursor.at("world").choice(worldNames());
  scene.precision = precisionAt(cursor);
  readVector(cursor, "gravity_m_s2", scene.gravity);
  readNumber(cursor, "step_s", Range{0, 1, false, "in (0, 1]"}, scene.step);
  if (const auto substeps = cursor.find("substeps")) scene.substeps = substeps->integer(1, 1000);
  if (const auto iterations = cursor.find("iterations")) scene.iterations = iterations->integer(1, 10000);
  if (const auto quality = cursor.find("quality")) {
    quality->choice(qualityNames());
    scene.quality = quality->text();
  }
  readNumber(cursor, "duration_s", Range::positive(), scene.duration);
  if (scene.duration / scene.step > mostSteps) {
    const auto duration = cursor.find("duration_s");
    (duration ? *duration : cursor.at("step_s")).complain("makes more than 2e9 steps of step_s, the most that are run");
  }
  if (const auto implicit = cursor.find("implicit")) {
    scene.implicit = implicit->boolean();
    if (scene.implicit && scene.world != WorldKind::deformable) {
      implicit->complain("only the world \"deformable\" has an implicit solver");
    }
  }
  if (const auto solver = cursor.find("solver")) {
    scene.clothSolver = readSolver(*solver);
    if (scene.clothSolver && scene.world == WorldKind::deformable) {
      solver->reject("\"bullet\" in the world \"deformable\"");
    }
  }
}

/// The file itself or, for a bare name that is not in the working directory, the scene that goes with the command
std::string sceneFile(const std::string& name) {
  std::error_code ignored;
  if (std::filesystem::path(name).has_parent_path() || std::filesystem::exists(name, ignored)) return name;
  const std::string file = dataFile("scenes/" + name);
  return std::filesystem::is_regular_file(file, ignored) ? file : name;
}

}  // namespace

PrecisionWish readPrecision(const std::string& given) {
  const std::string file = sceneFile(given);
  const Json json = loadJson(file);
  JsonCursor cursor(json, file);
  cursor.expectObject(keys::scene);
  return {precisionAt(cursor), file + ": /precision"};
}

Scene readScene(const std::string& given, const EffectCatalogue& catalogue) {
  const std::string file = sceneFile(given);
  return readScene(loadJson(file), file, catalogue);
}

Scene readScene(const Json& json, const std::string& file, const EffectCatalogue& catalogue) {
  JsonCursor cursor(json, file);
  cursor.expectObject(keys::scene);
  Scene scene;
  scene.file = file;
  scene.name = std::filesystem::path(file).stem().string();
  for (const char* key : {"$schema", "description"}) {
    if (const auto found = cursor.find(key)) found->text();
  }
  if (const auto name = cursor.find("name")) scene.name = name->text();
  readWorld(cursor, scene);
  if (const auto colliders = cursor.find("colliders")) {
    for (const JsonCursor& collider : colliders->elements()) scene.colliders.push_back(readCollider(collider));
  }
  if (const auto figures = cursor.find("figures")) {
    for (const JsonCursor& figure : figures->elements()) readFigure(figure, scene);
  }
  if (const auto water = cursor.find("water")) scene.water = readWater(*water);
  if (const auto drops = cursor.find("drops")) scene.drops = readDrops(*drops, scene);
  for (const JsonCursor& cloth : cursor.at("cloths").elements()) {
    scene.cloths.push_back(readCloth(cloth, scene, catalogue));
  }
  if (scene.cloths.empty()) cursor.at("cloths").reject("an array with at least one cloth");
  if (const auto camera = cursor.find("camera")) scene.camera = readCamera(*camera);
  return scene;
}

}  // namespace command
