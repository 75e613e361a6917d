// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/BulletWorld.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

namespace command {

/// A strip of cloth on a board, its lower end in water: immersion, diffusion and, if wanted, seepage, in Bullet's
/// world.
class WickingStrip {
 public:
  struct Settings {
    double length = 0.2;   ///< [m]
    double dipped = 0.01;  ///< of it [m]
    int rows = 121;
    double step = 0.5;  ///< [s]
    wetcloth::Fabric fabric = wetcloth::Fabric::cotton();
    wetcloth::Diffusion::Parameters diffusion;
    bool feelsGravity = true;
    wetcloth::Seepage::Parameters seepage;
  };

  /// Saturation at which the front is read.
  static constexpr double frontLevel = 0.05;

  explicit WickingStrip(const Settings& settings);

  /// Since the start [s].
  double time() const { return static_cast<double>(m_steps) * m_settings.step; }
  /// One step. Throws RunError when the cloth blows up.
  void advance();
  int rows() const { return m_settings.rows; }
  /// Above the water [m].
  double height(int row) const { return m_settings.length * row / (rows() - 1) - m_settings.dipped; }
  double saturation(int row) const { return m_cloth->saturation(m_patch.node(0, row)); }
  /// Height up to which the strip is wetter than frontLevel, between the rows linear [m].
  double front() const;

 private:
  Settings m_settings;
  BulletWorld m_world;
  wetcloth::ClothPatch m_patch;
  btSoftBody* m_body = nullptr;
  wetcloth::WetCloth* m_cloth = nullptr;
  long long m_steps = 0;
};

}  // namespace command
