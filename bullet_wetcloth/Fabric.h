// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <array>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a cloth is made of: how much water it takes, how fast, what it weighs and how it looks when dry.
///
/// Absorption follows Q(t) = capacity (1 - exp(-t / timeConstant)) (Basori et al. 2017, Eq. 2; the constants of
/// their Table I come from Chen et al. 2012).
struct WETCLOTH_EXPORT Fabric {
  /// For tables and messages.
  std::string name = "custom";

  /// Water held at saturation per dry mass, the paper's alpha [kg/kg], (0, inf).
  double capacity = 0.84;

  /// Time constant of absorption at full exposure, the paper's theta [s], (0, inf).
  double timeConstant = 8.844;

  /// Dry mass per area [kg/m^2], (0, inf). Used to build patches and for nodes whose mass Bullet does not know
  /// (pinned ones); the masses of an existing body's free nodes are its own.
  double arealDensity = 0.150;

  /// Diffuse colour of the dry fabric, linear RGB, each in [0, 1].
  std::array<double, 3> dryColour = {0.60, 0.60, 0.60};

  /// Roughness of the dry fabric for a renderer, [0, 1].
  double dryRoughness = 0.95;

  /// Table I, cotton: alpha 0.84, theta 8.844 s. Areal density: poplin, 150 g/m^2.
  static Fabric cotton();
  /// Table I, coarse wool: alpha 1.24, theta 4.8936 s. Areal density: 300 g/m^2.
  static Fabric coarseWool();
  /// Table I, "high absorption fabric": alpha 2.492, theta 3.3803 s. Areal density: terry, 400 g/m^2.
  static Fabric highAbsorption();
  /// The cloth of the paper's Table II: a node grows from 0.01 g to 0.84 g, so it holds 83 times its dry mass.
  /// That contradicts Table I (docs/paper.md); it exists to reproduce the paper. Areal density 10 g/m^2, so that
  /// a node of a 32 x 32 patch of about one square metre weighs the paper's 0.01 g.
  static Fabric tableII();

  /// All presets, in the order above. Their names are "cotton", "coarse_wool", "high_absorption", "table_ii".
  static const std::vector<Fabric>& presets();
  /// The preset of that name. Throws std::invalid_argument that lists the known names.
  static Fabric byName(const std::string& name);
};

/// Throws std::invalid_argument naming the field and its value when a field is out of its range. `name` is what the
/// message calls the fabric.
WETCLOTH_EXPORT void requireValid(const Fabric& fabric, const std::string& name = "fabric");

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
