// SPDX-License-Identifier: Zlib
// Diffusion against closed forms: steps of its solver, an error function, a point source, the front of a wetted strip.

#include "bullet_wetcloth/numerics/DiffusionSolver.h"
#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

namespace wetcloth_test::diffusion_closed_forms_test {

using namespace transport;

namespace {

using wetcloth::Diffusion;
using wetcloth::WeightedEdge;
using Method = Diffusion::Method;
using Values = std::vector<double>;

Diffusion::Parameters with(double diffusivity, double exponent = 0, Method method = Method::factored) {
  Diffusion::Parameters parameters;
  parameters.warpDiffusivity = parameters.weftDiffusivity = diffusivity;
  parameters.exponent = exponent;
  parameters.method = method;
  return parameters;
}

TEST(DiffusionFormulas, ThePotentialIsTheIntegralOfTheDiffusivity) {
  for (const double exponent : {0.0, 0.5, 1.0, 3.0, 10.0}) {
    EXPECT_EQ(wetcloth::diffusionPotential(0, exponent), 0);
    EXPECT_DOUBLE_EQ(wetcloth::diffusionPotential(1, exponent), 1 / (exponent + 1));
    for (const double s : {0.1, 0.5, 0.9}) {
      const double h = 1e-5;
      const double slope =
          (wetcloth::diffusionPotential(s + h, exponent) - wetcloth::diffusionPotential(s - h, exponent)) / (2 * h);
      // Central differences: h^2, and rounding over h.
      EXPECT_NEAR(slope, wetcloth::relativeDiffusivity(s, exponent), 1e-8);
    }
  }
}

// A row of finite volumes, half as large at the ends, whose modes cos(k pi x) decay with
// lambda_k = 4 D / h^2 sin^2(k pi h / 2).
struct Row {
  static constexpr int kNodes = 33;
  static constexpr double kSpacing = 1.0 / (kNodes - 1);
  std::vector<WeightedEdge> edges;
  Values capacities = Values(kNodes, kSpacing);
  Values potential;
  Values fluxes = Values(kNodes - 1);
  wetcloth::DiffusionSolver solver;

  explicit Row(int mode) {
    for (int i = 0; i + 1 < kNodes; ++i) edges.push_back({i, i + 1, 1 / kSpacing});
    capacities.front() = capacities.back() = kSpacing / 2;
    for (int i = 0; i < kNodes; ++i) potential.push_back(0.5 + 0.4 * std::cos(mode * kPi * i * kSpacing));
    solver.reset(kNodes);
  }
  static double decay(int mode) {
    const double sine = std::sin(mode * kPi * kSpacing / 2);
    return 4 / (kSpacing * kSpacing) * sine * sine;
  }
  double amplitudeAfter(int steps, double dt, Method method) {
    for (int n = 0; n < steps; ++n) {
      if (method == Method::factored) {
        solver.solveFactored(edges, capacities, potential, dt, fluxes);
      } else if (method == Method::conjugateGradients) {
        solver.solveIteratively(edges, capacities, potential, dt, 1e-14, fluxes);
      } else {
        explicitFluxes(edges, potential, dt, fluxes);
      }
      for (std::size_t e = 0; e < edges.size(); ++e) {
        potential[e] -= fluxes[e] / capacities[e];
        potential[e + 1] += fluxes[e] / capacities[e + 1];
      }
    }
    return (potential[0] - 0.5) / 0.4;
  }
};

TEST(DiffusionSolver, EachModeDecaysAsBackwardEulerHasIt) {
  for (const int mode : {1, 2, 5, 32}) {
    for (const double dt : {1e-6, 1e-3, 0.1}) {
      const double exact = std::pow(1 / (1 + dt * Row::decay(mode)), 5);
      EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::factored), exact, 1e-12) << mode << ' ' << dt;
      EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::conjugateGradients), exact, 1e-11) << mode << ' ' << dt;
    }
    const double dt = 1e-5;
    EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::explicitSubsteps), std::pow(1 - dt * Row::decay(mode), 5),
                1e-12);
  }
}

TEST(DiffusionSolver, IsOfFirstOrderInTime) {
  const double exact = std::exp(-0.1 * Row::decay(1));
  const double coarse = Row(1).amplitudeAfter(10, 0.01, Method::factored) - exact;
  const double fine = Row(1).amplitudeAfter(20, 0.005, Method::factored) - exact;
  EXPECT_GT(std::fabs(coarse), 1e-3);
  EXPECT_NEAR(coarse / fine, 2, 0.1);
}

// h^2 over the largest sum of conductances, 2 / h, in half a volume at the ends.
TEST(DiffusionSolver, KnowsTheLongestExplicitStep) {
  const Row row(1);
  EXPECT_NEAR(longestExplicitStep(row.edges, row.capacities), Row::kSpacing * Row::kSpacing / 2, 1e-15);
}

// Steps that jitter share a factor; the step is first order all the same.
TEST(DiffusionSolver, KeepsItsFactorWhileTheStepJitters) {
  Row row(1);
  for (int n = 0; n < 20; ++n) row.amplitudeAfter(1, n % 2 == 0 ? 1.0 / 60 : 0.95 / 60, Method::factored);
  EXPECT_EQ(row.solver.factorizations(), 1);
  row.amplitudeAfter(1, 0.02, Method::factored);
  EXPECT_EQ(row.solver.factorizations(), 2) << "longer";
  row.amplitudeAfter(1, 0.01, Method::factored);
  EXPECT_EQ(row.solver.factorizations(), 3) << "much shorter";
}

// One half wet, one half dry: s = erfc((x - 1/2) / (2 sqrt(D t))) / 2.
TEST(DiffusionClosedForms, AnEdgeSpreadsAsTheErrorFunction) {
  const int n = 81;
  const double d = 1e-3;
  for (const Method method : {Method::factored, Method::conjugateGradients, Method::explicitSubsteps}) {
    TransportScene scene(grid(n, 3, 1, 2.0 / (n - 1)));
    scene.wet([](double x, double) { return x < 0.4999 ? 1.0 : (x > 0.5001 ? 0.0 : 0.5); });
    scene.cloth().add<Diffusion>(with(d, 0, method));
    scene.run(200, 0.025);
    const double width = 2 * std::sqrt(d * 5);
    for (int i = 0; i < scene.count(); ++i) {
      // h^2 / 24 t and dt / 4 t of a second derivative of 0.2: 2e-4 each; the corners' volumes are not those of a row.
      EXPECT_NEAR(scene.s(i), 0.5 * std::erfc((scene.x(i) - 0.5) / width), 1.5e-3) << scene.x(i);
    }
  }
}

// A strip that dips into water: s = erfc(x / (2 sqrt(D t))).
TEST(DiffusionClosedForms, AStripWettedAtOneEndIsTheErrorFunction) {
  const int n = 81;
  const double d = 1e-3;
  TransportScene scene(grid(n, 3, 1, 2.0 / (n - 1)));
  scene.cloth().add(std::make_unique<DipsLeftEdge>());
  scene.cloth().add<Diffusion>(with(d));
  scene.run(4000, 0.0025);
  const double width = 2 * std::sqrt(d * 10);
  for (int i = 0; i < scene.count(); ++i) {
    // The end is full at the start of a step only: in it the row loses 2 dt D / (h sqrt(pi D t)) = 0.0023 of its water,
    // and the corners, which are smaller, three times that.
    EXPECT_NEAR(scene.s(i), std::erfc(scene.x(i) / width), 4e-3) << scene.x(i);
  }
}

// s = m / c / (4 pi t sqrt(D_u D_v)) exp(-u^2 / 4 D_u t - v^2 / 4 D_v t), with the warp at any angle to the mesh.
TEST(DiffusionClosedForms, APointSourceIsAGaussian) {
  const int n = 61;
  const double h = 1.0 / (n - 1);
  const double warp = 2e-3;
  for (const auto& [weft, degrees] : {std::pair(2e-3, 0.0), std::pair(0.7e-3, 0.0), std::pair(0.7e-3, 30.0)}) {
    TransportScene scene(grid(n, n, 1, 1));
    scene.wet([&](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < h / 2 ? 1 : 0; });
    Diffusion::Parameters parameters = with(warp);
    parameters.weftDiffusivity = weft;
    const double c = std::cos(degrees * kPi / 180);
    const double s = std::sin(degrees * kPi / 180);
    parameters.warp = btVector3(btScalar(3 * c), btScalar(3 * s), 1);
    scene.cloth().add<Diffusion>(parameters);
    const double t = 4;
    scene.run(400, t / 400);
    const double peak = h * h / (4 * kPi * t * std::sqrt(warp * weft));
    for (int i = 0; i < scene.count(); ++i) {
      const double x = scene.x(i) - 0.5;
      const double y = scene.y(i) - 0.5;
      const double u = c * x + s * y;
      const double v = c * y - s * x;
      const double exact = peak * std::exp(-u * u / (4 * warp * t) - v * v / (4 * weft * t));
      // h^2 / 2 D_v t = 5 %, a part of it at the peak; dt / 2 t; and at the border of the square what is reflected.
      EXPECT_NEAR(scene.s(i), exact, 0.03 * peak) << x << ' ' << y << " warp at " << degrees;
    }
  }
}

// The strip's profile for D(s) = s^2 at t = 1 as a fine one-dimensional explicit scheme has it, at intervals of 1 /
// kPerUnit.
class Reference {
 public:
  static constexpr int kPerUnit = 100;
  Reference() : m_s(2 * kPerUnit + 1, 0.0) {
    const double h = 1.0 / kPerUnit;
    const int steps = int(1 / (0.4 * h * h));
    m_s[0] = 1;
    Values phi(m_s.size());
    for (int n = 0; n < steps; ++n) {
      for (std::size_t i = 0; i < m_s.size(); ++i) phi[i] = m_s[i] * m_s[i] * m_s[i] / 3;
      for (std::size_t i = 1; i + 1 < m_s.size(); ++i) m_s[i] += 0.4 * (phi[i - 1] - 2 * phi[i] + phi[i + 1]);
    }
  }
  double at(double x) const {
    const double place = x * kPerUnit;
    const std::size_t i = std::size_t(place);
    return i + 1 < m_s.size() ? m_s[i] + (place - double(i)) * (m_s[i + 1] - m_s[i]) : 0;
  }
  double whereItFallsTo(double s) const {
    double x = 0;
    while (at(x) > s) x += 1e-3;
    return x;
  }

 private:
  Values m_s;
};

double frontOf(TransportScene& scene, double s) {
  double front = 0;
  for (int i = 0; i < scene.count(); ++i) {
    if (scene.s(i) < s) continue;
    const double next = scene.x(i + 1) > scene.x(i) ? scene.s(i + 1) : 0;
    const double beyond = next < s ? (scene.s(i) - s) / (scene.s(i) - next) * (scene.x(1) - scene.x(0)) : 0;
    front = std::max(front, scene.x(i) + beyond);
  }
  return front;
}

// Washburn's law: the front's square grows in proportion to time, by the number that the reference has.
TEST(DiffusionClosedForms, AFrontAdvancesWithTheRootOfTime) {
  const Reference reference;
  const double level = 0.3;
  const double slope = std::pow(reference.whereItFallsTo(level), 2);
  const int n = 81;
  const double d = 1e-3;
  for (const Method method : {Method::factored, Method::explicitSubsteps}) {
    TransportScene scene(grid(n, 3, 1, 2.0 / (n - 1)));
    scene.cloth().add(std::make_unique<DipsLeftEdge>());
    scene.cloth().add<Diffusion>(with(d, 2, method));
    for (int quarter = 1; quarter <= 4; ++quarter) {
      scene.run(5000, 0.01);
      const double t = 50 * quarter;
      // First order in h / front at the first quarter: 1/160 of 0.2.
      EXPECT_NEAR(std::pow(frontOf(scene, level), 2), slope * d * t, 0.03 * slope * d * t) << t;
    }
    const double width = std::sqrt(d * 200);
    for (int i = 0; i < scene.count(); ++i) {
      // At the front itself, where the profile is steep, a place is known to a spacing.
      if (scene.s(i) < 0.3) continue;
      EXPECT_NEAR(scene.s(i), reference.at(scene.x(i) / width), 0.015) << scene.x(i);
    }
    // Dry beyond: with D(0) = 0 no water runs ahead.
    EXPECT_LT(scene.s(n - 1), 1e-12);
  }
}

}  // namespace
}  // namespace wetcloth_test::diffusion_closed_forms_test
