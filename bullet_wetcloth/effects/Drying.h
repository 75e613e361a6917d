// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/effects/Exposure.h"
#include "bullet_wetcloth/effects/WindField.h"
#include "bullet_wetcloth/numerics/NothingLeft.h"
#include "bullet_wetcloth/numerics/RoundingCarry.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class RestMesh;

/// Pressure of water vapour over water at this temperature [Pa] (Tetens 1930): 610.8 exp(17.27 T / (T + 237.3)).
/// @param temperature T [degC], within 0.2 % in [0, 60]
WETCLOTH_EXPORT double saturationVapourPressure(double temperature);

/// Water that a wet surface gives to the air [kg/m^2/s], for each side: the aerodynamic term of Penman (1948) in the
/// units of Shuttleworth (1993, Eq. 4.2.30), 6.43 MJ/m^2/day/kPa (1 + 0.536 u) e_s(T) (1 - RH) / lambda with lambda
/// 2.45 MJ/kg. The surface is as warm as the air: see Drying::Parameters::selfCooling.
/// @param temperature T [degC]; @param relativeHumidity RH, [0, 1]; @param airSpeed u, relative to the surface [m/s]
WETCLOTH_EXPORT double evaporationRate(double temperature, double relativeHumidity, double airSpeed);

/// Water that dries off in dt [kg], exact for any dt and across the change of stage (two periods of drying: Sherwood
/// 1929): dw/dt = -rate while w > w_c, -rate w / w_c below.
/// @param held w [kg], >= 0; @param critical w_c [kg], > 0; @param rate E A [kg/s], >= 0; @param dt [s], >= 0
WETCLOTH_EXPORT double dryingStep(double held, double critical, double rate, double dt);

/// Time in which `from` dries down to `to` by the same law [s]: infinite when `to` or the rate is 0, and 0 when there
/// is nothing to dry.
WETCLOTH_EXPORT double dryingTime(double from, double to, double critical, double rate);

/// Lets a cloth dry: each node loses water by its area at rest, at a constant rate as long as its surface is wet, then
/// in proportion to what is left above what the fibres keep in that air. Does not know what is under water or indoors:
/// that is for `exposure` to say.
class WETCLOTH_EXPORT Drying : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double temperature = 20;        ///< of the air and the cloth [degC], [0, 60]
    double relativeHumidity = 0.5;  ///< [0, 1]; 1: nothing dries
    /// Velocity of the air [m/s]: a constant, or a function of position and time, asked for the middle of the step. Its
    /// speed relative to the moving node counts.
    WindField air = {};
    /// Saturation at which the surface begins to fall dry, (0, 1]. A guess.
    double criticalSaturation = 0.3;
    /// Saturation that the fibres keep in this air, however long they hang in it [0, criticalSaturation): moisture
    /// regain over capacity. What is above it dries. 0 by default: a cloth is dry at the mass that it has in the air.
    double equilibriumSaturation = 0;
    double sides = 2;  ///< of the cloth that air reaches, (0, 2]
    /// Share of the rate that remains when drying cools the cloth below the air, (0, 1]; 1: something keeps it as warm
    /// as the air. 0.49 in calm air of 20 C, less in wind (docs/fabrics.md); two sides then dry 128 g/m^2/h by default.
    double selfCooling = 0.5;
    /// Share of a node's area that air reaches, [0, 1]: a constant, one value per node, or a function of the node's
    /// position and normal and of time, asked for the middle of the step.
    Exposure exposure = 1.0;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Drying(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, or when an exposure has not one value per node,
  /// and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Drying"; }
  Stage stage() const override { return Stage::losses; }
  /// Throws std::invalid_argument when the body has no faces, or when the effect is added and an exposure has not one
  /// value per node.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Nodes visited so far: for tests that count work. A dry cloth adds none.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  double rateOf(const WetCloth& cloth, const Step& step, std::size_t node) const;
  bool isCovered(std::size_t node) const;
  bool dry(WetCloth& cloth, const Step& step, std::size_t node);

  Parameters m_parameters;
  double m_stillAirRate = 0;         // of all sides [kg/m^2/s]
  const RestMesh* m_mesh = nullptr;  // the cloth's own
  RoundingCarry m_carry;
  NothingLeft m_nothingLeft;
  bool m_hasNormals = false;
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
