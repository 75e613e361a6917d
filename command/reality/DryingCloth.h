// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Specimen.h"

namespace reality {

/// A flat piece of cloth that hangs still in the air and dries.
class DryingCloth {
 public:
  struct Settings {
    wetcloth::Fabric fabric;
    double area;                ///< [m^2]
    double water;               ///< at first [kg]
    double rate;                ///< while it is wet, both sides together [kg/m^2/s]
    double criticalSaturation;  ///< [-]
  };

  explicit DryingCloth(const Settings& settings);

  /// One step of this length [s].
  void advance(double dt);
  double time() const { return m_time; }
  /// That it holds [kg].
  double water();

 private:
  accuracy::Specimen m_specimen;
  double m_time = 0;
};

}  // namespace reality
