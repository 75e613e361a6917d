// SPDX-License-Identifier: Zlib
#include "command/run/RunSeries.h"

#include "command/run/Saturation.h"

#include <algorithm>

namespace command {
namespace {

wetcloth::Ledger ledgerOf(const SceneWorld& world) {
  wetcloth::Ledger sum;
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    const wetcloth::Ledger ledger = cloth->ledger();
    sum.held += ledger.held;
    sum.absorbed += ledger.absorbed;
    sum.dripped += ledger.dripped;
    sum.evaporated += ledger.evaporated;
  }
  return sum;
}

/// Of the centre of mass, along up [m].
double heightOf(const SceneWorld& world) {
  const btVector3 up = world.scene().up();
  double moment = 0;
  double mass = 0;
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    for (int i = 0; i < cloth->nodeCount(); ++i) {
      const double node = cloth->dryMass(i) + cloth->held(i);
      moment += node * static_cast<double>(up.dot(cloth->body().m_nodes[i].m_x));
      mass += node;
    }
  }
  return mass > 0 ? moment / mass : 0;
}

double largest(const pictures::Frame& frame, const std::vector<float> pictures::ClothState::*values) {
  float largest = 0;
  for (const pictures::ClothState& cloth : frame.cloths) {
    for (const float value : cloth.*values) largest = std::max(largest, value);
  }
  return static_cast<double>(largest);
}

}  // namespace

std::vector<double> measureRun(const SceneWorld& world, const pictures::Frame& frame) {
  const wetcloth::Ledger ledger = ledgerOf(world);
  return {ledger.held,
          ledger.absorbed,
          ledger.dripped,
          ledger.evaporated,
          saturationOf(world).mean,
          heightOf(world),
          largest(frame, &pictures::ClothState::speed),
          largest(frame, &pictures::ClothState::stretch)};
}

std::vector<pictures::Series> runSeries() {
  return {{"water held", "kg", {}},
          {"water absorbed", "kg", {}},
          {"water dripped", "kg", {}},
          {"water evaporated", "kg", {}},
          {"mean saturation", "1", {}},
          {"height of the centre of mass", "m", {}},
          {"speed of the fastest node", "m/s", {}},
          {"largest stretch", "1", {}}};
}

}  // namespace command
