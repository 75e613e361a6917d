// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <vector>

namespace accuracy {

/// Points of mass and springs in double, by velocity Verlet (Swope et al. 1982): of second order, symplectic, so that
/// without damping the energy stays near its first value for ever. What cloths in Bullet are compared with, and shares
/// no code with them or with the library.
class MassSpringReference {
 public:
  using Vector = std::array<double, 3>;
  struct Point {
    Vector position;  ///< [m]
    double mass;      ///< [kg], > 0
    bool isFixed = false;
    Vector velocity = {};      ///< [m/s]
    Vector acceleration = {};  ///< kept from step to step [m/s^2]
  };
  struct Spring {
    int a;
    int b;
    double restLength;  ///< [m]
    double stiffness;   ///< [N/m], >= 0
  };

  /// @param gravity  along -y [m/s^2]
  MassSpringReference(std::vector<Point> points, std::vector<Spring> springs, double gravity);

  /// @param dt  > 0 [s]; stable below 2 / the highest angular frequency
  void step(double dt);

  const std::vector<Point>& points() const { return m_points; }
  /// Mean position of all points by mass [m].
  Vector centreOfMass() const;
  /// Kinetic, of gravity (0 at height 0) and of the springs [J].
  double kineticEnergy() const;
  double gravityEnergy() const;
  double springEnergy() const;

 private:
  void accelerate();

  std::vector<Point> m_points;
  std::vector<Spring> m_springs;
  double m_gravity;
};

}  // namespace accuracy
