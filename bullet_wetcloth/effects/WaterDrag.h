// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/effects/WaterSurface.h"
#include "bullet_wetcloth/mesh/RestMesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

struct FlatTriangle;
struct FluidResistance;

/// Volume of a piece of wet cloth without the air in it [m^3]: dry mass / fibre density + held water / 1000 kg/m^3.
WETCLOTH_EXPORT double displacedVolume(double dryMass, double fibreDensity, double held);

/// Speed at which a level sheet sinks in the end [m/s], wet or dry, since water in water weighs nothing; negative: it
/// rises. Balance of its weight in water and of its resistance: v^2 = 2 sigma (1 - rho / rho_f) g / (rho C_d).
/// @param arealDensity sigma, dry [kg/m^2]; @param fibreDensity rho_f, @param waterDensity rho [kg/m^3]
/// @param dragCoefficient C_d [-]; @param gravity g [m/s^2]
WETCLOTH_EXPORT double sinkingSpeed(double arealDensity, double fibreDensity, double waterDensity,
                                    double dragCoefficient, double gravity);

/// Resistance and buoyancy of what is below a water surface, node by node: a triangle's force goes to those of its
/// corners that are under water.
///
/// Resistance is Wind's quadratic law in water, integrated in the same way: stable at any speed and step. Buoyancy is
/// rho g times the displaced volume, against gravity. The water around the cloth has no inertia of its own (added mass
/// is neglected): speeds in the end are right, and the way there is quicker than in life. Waves and the water's own
/// motion are not simulated.
///
/// Wind knows of no water: what is submerged feels it, too, at an 800th of the force. A body whose m_cfg.kDG or kLF
/// is set (Bullet's default is 0) also feels Bullet's own aerodynamics.
class WETCLOTH_EXPORT WaterDrag : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// None: the surface that the application has given to Bullet (btSoftBodyWorldInfo::water_normal and so on), as it
    /// is in each step.
    std::optional<WaterSurface> surface = {};
    double dragCoefficient = 1.2;  ///< C_d of a flat plate across the stream [-], >= 0, as in Wind
    /// C_f along the surface, both sides together [-], >= 0: a smooth plate at Re 10^6, 2 x 0.074 Re^(-1/5)
    /// (Schlichting).
    double skinFriction = 0.01;
    double fibreDensity = 1540;  ///< rho_f [kg/m^3], > 0: cotton (Morton & Hearle 2008); polyester 1390
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit WaterDrag(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. A surface of none
  /// is Bullet's own again, or no water.
  void setParameters(Parameters parameters);

  const char* name() const override { return "WaterDrag"; }
  Stage stage() const override { return Stage::forces; }
  /// Throws std::invalid_argument when the body has no faces, or when the effect is added and there is no water
  /// surface.
  void attach(WetCloth& cloth) override;
  bool usesPackedNodes() const override { return true; }
  void apply(WetCloth& cloth, const Step& step) override;
  /// When, since the last apply(), the water has reached the body or left it; and for a body in it when the level has
  /// moved by a thousandth of the body's size, its slope by 1e-3, its velocity by more than a tenth, or 0.01 m/s, its
  /// density by 1 %; and when the other parameters have been changed.
  bool wakes(const WetCloth& cloth, const Step& step) const override;
  void transferState(StateArchive& archive) override;

  /// Force of the water on the whole cloth in the last step, buoyancy included [N].
  btVector3 totalForce() const { return m_totalForce; }
  /// Nodes visited so far: for tests that count work. A cloth that is well above the water adds none.
  long long nodesVisited() const { return m_nodesVisited; }
  /// The same for triangles: a cloth that is not in the water adds none.
  long long trianglesVisited() const { return m_trianglesVisited; }

 private:
  struct NodeState {
    btScalar specificArea = 0;                  // area over mass, 0 when pinned [m^2/kg]
    btScalar drag = 0;                          // force per relative speed, over all triangles [kg/s]
    btVector3 lift = btVector3(0, 0, 0);        // buoyancy [N]
    btVector3 relative = btVector3(0, 0, 0);    // velocity of the water relative to the node [m/s]
    btVector3 resistance = btVector3(0, 0, 0);  // [N]
  };

  using Triangle = std::array<int, 3>;

  bool findImmersed(const PackedNodes& nodes);
  void look(const WetCloth& cloth, const PackedNodes& nodes, const Step& step);
  void accumulate(const PackedNodes& nodes, const Step& step);
  void resist(const Triangle& triangle, const FlatTriangle& shape, const FluidResistance& resistance);
  void push(PackedNodes& nodes, const Step& step);

  Parameters m_parameters;
  const RestMesh* m_mesh = nullptr;
  std::vector<Triangle> m_triangles;  // each layer once
  std::vector<unsigned char> m_isImmersed;
  std::vector<NodeState> m_nodes;         // of those that are immersed
  std::optional<WaterSurface> m_surface;  // in the last step
  btVector3 m_totalForce = btVector3(0, 0, 0);
  long long m_nodesVisited = 0;
  long long m_trianglesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
