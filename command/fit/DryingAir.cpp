// SPDX-License-Identifier: Zlib
#include "command/fit/DryingAir.h"

#include <algorithm>

namespace fit {

wetcloth::Drying::Parameters airThatDries(double rate) {
  constexpr double least = 1e-9, fastest = 1e6;  // of a share [-]; of wind [m/s]: a search may ask for anything
  wetcloth::Drying::Parameters air;
  const auto rateIn = [&](double speed) {
    return air.sides * air.selfCooling * wetcloth::evaporationRate(air.temperature, air.relativeHumidity, speed);
  };
  const double calm = rateIn(0);
  if (rate <= calm) {
    air.selfCooling *= std::max(rate / calm, least);
  } else {
    const double growth = rateIn(1) - calm;  // it is linear in the speed
    air.air = btVector3(static_cast<btScalar>(std::min((rate - calm) / growth, fastest)), 0, 0);
  }
  return air;
}

}  // namespace fit
