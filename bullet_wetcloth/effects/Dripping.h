// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/numerics/NothingLeft.h"
#include "bullet_wetcloth/numerics/RoundingCarry.h"
#include "bullet_wetcloth/numerics/SpannedAreas.h"
#include "bullet_wetcloth/numerics/SteadyState.h"
#include "bullet_wetcloth/water/Water.h"

#include <LinearMath/btVector3.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Water that drips in dt from a node above its holding capacity [kg], exact for any dt: (w - H) (1 - exp(-dt / tau)),
/// from dw/dt = -(w - H) / tau while w > H; 0 at or below H. A linear reservoir (Maillet 1905), as drainage after
/// saturation is modelled in canopies (Rutter et al. 1971 have the rate grow faster than that).
/// @param held w [kg]; @param holding H, water that surface tension keeps [kg]; @param timeConstant tau [s], > 0
WETCLOTH_EXPORT double drippingStep(double held, double holding, double timeConstant, double dt);

/// Whether `other` lies lower than x by more than `slopeTolerance` times their distance.
/// @param down  unit vector along gravity
WETCLOTH_EXPORT bool isLower(const btVector3& other, const btVector3& x, const btVector3& down, double slopeTolerance);

/// Room that the pores of squeezed cloth have for water, as a share of their room at rest: 1 - squeeze (1 - spanned).
/// The library's own model, with no measurement behind it: pores lose room as the area disappears that cloth spans,
/// whether it is pressed together or crumples; stretched cloth gains none. Pressure between layers is not looked at.
/// @param spanned  area that the node's triangles span, as a share of that at rest, [0, 1]: SpannedAreas
/// @param squeeze  [0, 1]
inline double squeezedRoom(double spanned, double squeeze) { return 1 - squeeze * (1 - spanned); }

/// A drop that has fallen from a cloth. The library does not follow it: an application may make a particle of it.
struct Drip {
  double time;         ///< start of the step of water in which it fell [s]
  btVector3 position;  ///< of the node [m]
  btVector3 velocity;  ///< of the node, which the drop takes along [m/s]
  double mass;         ///< [kg], >= Dripping::Parameters::dropMass
  int node;            ///< in btSoftBody::m_nodes
  WetCloth* cloth;     ///< never null
};

/// Lets water above the holding capacity drip from low points: nodes none of whose neighbours in the mesh lies lower
/// along gravity. A level hem drips all along, and a level cloth everywhere: what it may lie on is not looked at.
///
/// With `squeeze` water is pressed out, too: see squeezedRoom(). A node then holds no more than its room, wherever it
/// lies, and a low point holdingSaturation of its room. What is pressed out leaves where it is pressed out, at the rate
/// of what drips: it is not followed as it runs down the outside of the cloth.
///
/// Water leaves the cloth continuously, with its node's velocity; it is reported in drops. Pinned nodes drip, too.
/// Without gravity nothing drips.
class WETCLOTH_EXPORT Dripping : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// Saturation that a node keeps, [0, 1]. A guess: no measured value for hung cloth was found.
    double holdingSaturation = 0.6;
    double timeConstant = 3;  ///< tau, of what is above that [s], > 0; a guess
    /// Mass of a drop [kg], >= 0: 0.05 ml, which surface tension holds at a tip of r = 1.1 mm, 2 pi r gamma = m g (Tate
    /// 1864). A node reports what has left it once that is a drop or more; 0: after each step in which it dripped.
    double dropMass = 5e-5;
    /// Sine of the slope below which a neighbour counts as no lower, [0, 1]; about a degree, a guess. With 0 the last
    /// digit decides whether a level hem drips; with 1 every node is a low point.
    double slopeTolerance = 0.02;
    /// How much room for water goes with the area that goes when cloth is compressed, crumpled or wrung, [0, 1]: 0
    /// none, 1 in proportion.
    double squeeze = 0;
    /// Takes each drop, inside the step and before Bullet's own. It may add rigid bodies to the world; it must not
    /// change soft bodies, effects or water. If it throws, this effect is removed with a message, as any that throws.
    std::function<void(const Drip&)> onDrip = {};
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Dripping(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. Not from inside
  /// onDrip.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Dripping"; }
  Stage stage() const override { return Stage::losses; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Drops reported so far.
  long long drops() const { return m_drops; }
  /// Water that has dripped through this effect [kg]: the reported drops and pendingMass(), to rounding.
  double drippedMass() const { return m_dripped.value(); }
  /// Water that has left the cloth and is no full drop yet [kg].
  double pendingMass() const;

  /// Nodes visited so far: for tests that count work. A cloth with nothing above its holding capacity adds none.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  bool isLowPoint(const btSoftBody& body, std::size_t node, const btVector3& down) const;
  double holding(const WetCloth& cloth, std::size_t node, const btVector3& down) const;
  void shed(Water& water, std::size_t node, double holding, double dt);
  void report(WetCloth& cloth, const Step& step, std::size_t node);

  Parameters m_parameters;
  const RestMesh* m_mesh = nullptr;
  RoundingCarry m_carry;
  std::vector<double> m_pending;  // what left each node since its last drop [kg]
  CompensatedSum m_dripped;
  long long m_drops = 0;
  SpannedAreas m_spans;
  SteadyState m_steadyState{SteadyState::DependsOn::waterAndShape};
  NothingLeft m_nothingLeft;  // above what a node holds however it is squeezed
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
