// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/NamedValues.h"
#include "command/cli/Precision.h"
#include "command/scene/Collider.h"
#include "command/scene/DropsScene.h"
#include "command/scene/Region.h"
#include "command/scene/TriangleMesh.h"

#include "bullet_wetcloth/bullet_wetcloth.h"

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace command {

enum class WorldKind { softRigid, softMultiBody, deformable };
const NamedValues<WorldKind>& worldNames();
std::string nameOf(WorldKind world);

/// Who steps the cloths.
enum class SolverKind { bullet, wetcloth };
const NamedValues<SolverKind>& solverNames();
std::string nameOf(SolverKind solver);
/// Takes that one; where ours was taken before, its numbers stay. None: Bullet's own.
void choose(SolverKind solver, std::optional<wetcloth::ClothSolver::Parameters>& chosen);

/// Springs of Bullet's deformable world, btDeformableMassSpringForce; its other worlds do not read them.
struct DeformableSprings {
  double stiffness = 100;       ///< [N/m]
  double bendingStiffness = 1;  ///< [N/m]
  double damping = 0.01;        ///< [N s/m]
};

/// What a scene says of them; what it does not say is chosen to be stable (springsOf()).
struct SpringScene {
  std::optional<double> stiffness;         ///< [N/m]
  std::optional<double> bendingStiffness;  ///< [N/m]
  double damping = 0.01;                   ///< [N s/m]
};

/// An edge of a patch, pinned, that turns about the line through its middle and that of the opposite edge.
struct TwistScene {
  wetcloth::ClothPatch::Edge edge = wetcloth::ClothPatch::Edge::top;
  double turnsPerSecond = 1;
  double turns = 1;     ///< in all
  double approach = 0;  ///< towards the opposite edge in all these turns [m], in proportion to them
  double letGo = std::numeric_limits<double>::infinity();  ///< when its nodes are pinned no more [s]
};

/// A patch's or mesh's pinned nodes, moved together: where to at which time, in straight lines between.
struct MotionScene {
  std::vector<double> times;       ///< [s], each later than the one before
  std::vector<btVector3> offsets;  ///< from where the nodes begin [m], one for each time
};

/// A scene's colliders in Bullet's world, in the scene's order.
using Colliders = std::vector<const btCollisionObject*>;

/// Adds an effect to a cloth, or gives one that is there these parameters. Throws std::invalid_argument when the
/// library refuses it.
using AddEffect = std::function<wetcloth::Effect&(wetcloth::WetCloth& cloth, const Colliders& colliders)>;

/// What an effect does with water: a scene without water does without all but those of none.
enum class WaterRole { none, brings, moves, takes };

/// An effect that a cloth of a scene asks for.
struct EffectScene {
  std::string key;  ///< as the scene spells it
  AddEffect addTo;
  WaterRole water = WaterRole::none;
  double speed = 0;  ///< of the air and water that its parameters name, all together [m/s]
};

/// What is special about a cloth that is sewn of panels; its shape is the sewn mesh.
struct GarmentScene {
  double sewing = 1;                      ///< time before the beginning in which the seams are drawn together [s]
  double settling = 1;                    ///< after that, still before the beginning [s]
  std::vector<wetcloth::Fabric> fabrics;  ///< the first is the cloth's own
  std::vector<int> fabricOfNode;          ///< of each node the number in `fabrics`
  std::vector<int> fabricOfTriangle;      ///< the same of each triangle
};

/// What of a cloth, by where its nodes are at the beginning, is not as wet as the rest.
struct WetRegion {
  Region region;
  double saturation;
};

struct ClothScene {
  std::string name;
  std::variant<wetcloth::ClothPatch, TriangleMesh> shape;
  std::optional<GarmentScene> garment;
  std::vector<int> pinnedNodes;  ///< of a mesh; a patch knows its own
  wetcloth::Fabric fabric;
  double initialSaturation = 0;
  std::vector<WetRegion> wetRegions;  ///< where they overlap the last one counts
  wetcloth::WaterPace pace;
  double friction = 0.5;          ///< btSoftBody::Config::kDF, [0, 1]
  double damping = 0;             ///< btSoftBody::Config::kDP, [0, 1]
  double margin = 0.02;           ///< of collision [m]
  std::optional<int> collisions;  ///< btSoftBody::fCollision; none: the world's usual ones
  bool selfCollision = false;     ///< btSoftBody::setSelfCollision()
  /// Among colliders that move, which would go through the cloth with Bullet's hardness of contacts with what is static
  /// or kinematic, btSoftBody::Config::kKHR = 0.1; it is 1 then.
  bool meetsWhatMoves = false;
  int clusters = 0;  ///< btSoftBody::generateClusters(); 0: none
  std::optional<TwistScene> twist;
  std::optional<MotionScene> motion;
  SpringScene springs;
  std::vector<EffectScene> effects;  ///< in the order in which they are added

  /// Of another fabric; panels that have their own keep it.
  void makeOf(const wetcloth::Fabric& other);
  /// No water at the beginning.
  void makeDry();
  bool hasEffect(const std::string& key) const;
  int nodeCount() const;
  std::vector<btVector3> nodePositions() const;  ///< at the beginning [m]
  bool hasPins() const;
  /// No less than the speed of anything that moves the cloth, but for its weight [m/s].
  double fastestPush() const;
};

/// A level surface of water, which Bullet is told of (btSoftBodyWorldInfo::water_normal and so on).
struct WaterScene {
  double level = 0;       ///< its height, against gravity, above the origin [m]
  double density = 1000;  ///< [kg/m^3]
};

struct CameraScene {
  btVector3 direction =
      btVector3(btScalar(-0.45), btScalar(-0.35), -1);  ///< looked along; the distance is fitted to the scene
  double fieldOfView = 30;                              ///< vertical [degrees]
};

/// Where cloths are at the beginning that are sewn and settle before it.
struct Dressed {
  std::vector<std::vector<btVector3>> places;  ///< of each cloth's nodes [m]; empty: not found yet
};

constexpr double mostSteps = 2e9;  ///< of a run

struct Scene {
  std::string file;
  std::string name;
  WorldKind world = WorldKind::softRigid;
  Precision precision = Precision::float32;
  btVector3 gravity = btVector3(0, btScalar(-9.81), 0);
  double step = 1.0 / 60;  ///< [s]
  int substeps = 4;        ///< per step
  int iterations = 10;
  double duration = 5;  ///< [s]
  bool implicit = false;
  std::optional<wetcloth::ClothSolver::Parameters> clothSolver;  ///< none: Bullet's own solver
  std::string quality;  ///< a name of qualityNames(); empty: substeps and iterations as they are here
  std::vector<ClothScene> cloths;
  std::vector<Collider> colliders;  ///< those of figures are the last
  std::vector<FigureScene> figures;
  std::optional<WaterScene> water;
  std::optional<DropsScene> drops;  ///< none: what leaves a cloth is gone
  CameraScene camera;
  std::shared_ptr<Dressed> dressed =
      std::make_shared<Dressed>();  ///< found when it is first asked for (dressedPlaces())
  std::vector<std::string> hints;   ///< what is allowed and rarely meant, one line each

  SolverKind solver() const { return clothSolver ? SolverKind::wetcloth : SolverKind::bullet; }
  bool hasGarments() const;
  /// Against gravity, of length 1; y without gravity.
  btVector3 up() const;
};

}  // namespace command
