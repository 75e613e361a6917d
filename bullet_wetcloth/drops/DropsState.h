// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/drops/BodyTargets.h"
#include "bullet_wetcloth/drops/ClothTarget.h"
#include "bullet_wetcloth/drops/DropList.h"
#include "bullet_wetcloth/drops/Drops.h"
#include "bullet_wetcloth/drops/Spouts.h"
#include "bullet_wetcloth/water/BodyFilms.h"
#include "bullet_wetcloth/water/Water.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What Drops has. `accounts` are sums of water [kg] since the beginning.
struct Drops::State {
  static constexpr std::size_t kMostFilmCells = 8192;

  struct Followed {
    ClothTarget target;
    Ledger before;      // when it was first followed
    double shedBefore;  // what nodes had shed then [kg]
    double handedOverBefore;
  };
  struct Accounts {
    CompensatedSum poured;
    CompensatedSum taken;     // by cloths from drops
    CompensatedSum returned;  // what of these cloths could not take, and shed
    CompensatedSum left;
  };
  struct Counts {
    long long born = 0;
    long long landedOnCloth = 0;
    long long ended = 0;
  };

  explicit State(Parameters given) : parameters(std::move(given)), films(filmsFor(parameters)) {}
  static BodyFilms filmsFor(const Parameters& parameters) {
    const double area = parameters.filmCell * parameters.filmCell;
    return BodyFilms(parameters.filmCell, parameters.filmDensity * area, kMostFilmCells);
  }

  Parameters parameters;
  std::optional<WaterSurface> surface;  // with a normal of length 1
  DropList drops;
  std::vector<std::unique_ptr<Followed>> cloths;  // in the order of the world's
  WorldLedger gone;                               // of cloths that were removed
  BodyTargets bodies;
  BodyFilms films;
  Spouts spouts;
  Accounts accounts;
  Counts counts;
  double lastStep = 0;       // dt of the last substep [s], 0 before the first
  double time = 0;           // at which drops are where they are [s]
  bool areFollowed = false;  // bodies and cloths, as they move
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
