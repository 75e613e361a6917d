// SPDX-License-Identifier: Zlib
// Diffusion against closed forms: steps of its solver, an error function, a point source, the front of a wetted strip.

#include "bullet_wetcloth/numerics/DiffusionSolver.h"
#include "bullet_wetcloth/numerics/DiffusionStep.h"
#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

#include <algorithm>

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
  Values saturation;
  Values fluxes = Values(kNodes - 1);
  wetcloth::DiffusionSolver solver;
  wetcloth::DiffusionStep step;

  explicit Row(int mode) {
    for (int i = 0; i + 1 < kNodes; ++i) edges.push_back({i, i + 1, 1 / kSpacing});
    capacities.front() = capacities.back() = kSpacing / 2;
    for (int i = 0; i < kNodes; ++i) saturation.push_back(0.5 + 0.4 * std::cos(mode * kPi * i * kSpacing));
    solver.reset(kNodes);
    step.reset(kNodes, edges.size());
  }
  static double decay(int mode) {
    const double sine = std::sin(mode * kPi * kSpacing / 2);
    return 4 / (kSpacing * kSpacing) * sine * sine;
  }
  double amplitude() const { return (saturation[0] - 0.5) / 0.4; }
  void smooth(double tau, Method method, Values& potential) {
    if (method == Method::factored) {
      solver.smoothFactored(edges, capacities, tau, potential);
    } else {
      solver.smoothIteratively(edges, capacities, tau, 1e-14, potential);
    }
  }
  double amplitudeAfter(int steps, double dt, Method method) {
    const double tau = wetcloth::DiffusionStep::kGamma * dt;
    const auto potential = [](double s) { return s; };
    for (int n = 0; n < steps; ++n) {
      if (method == Method::explicitSubsteps) {
        explicitFluxes(edges, saturation, dt, fluxes);
      } else {
        step.solve(
            edges, capacities, saturation, dt, potential, [&](Values& p) { smooth(tau, method, p); }, fluxes);
      }
      for (std::size_t e = 0; e < edges.size(); ++e) {
        saturation[e] -= fluxes[e] / capacities[e];
        saturation[e + 1] += fluxes[e] / capacities[e + 1];
      }
    }
    return amplitude();
  }
};

// The first and the last node are those of a mode's crests: what is between them is its amplitude.
TEST(DiffusionSolver, SmoothsEachModeByItself) {
  for (const Method method : {Method::factored, Method::conjugateGradients}) {
    for (const int mode : {1, 2, 5, 32}) {
      for (const double tau : {1e-6, 1e-3, 0.1, 1e3}) {
        Row row(mode);
        row.smooth(tau, method, row.saturation);
        const double height = row.saturation[0] - row.saturation[std::size_t(Row::kNodes - 1) / std::size_t(mode)];
        const double before =
            mode == 32 ? 0.8 : 0.4 * (1 - std::cos(mode * kPi * ((Row::kNodes - 1) / mode) * Row::kSpacing));
        EXPECT_NEAR(height, before / (1 + tau * Row::decay(mode)), 1e-12) << mode << ' ' << tau;
      }
    }
  }
}

// R(z) = (1 + (1 - 2 g) z) / (1 - g z)^2, g = 1 + 1/sqrt(2), z = -dt times the mode's decay (Verwer et al. 1999).
TEST(DiffusionStep, EachModeDecaysAsTheStabilityFunctionHasIt) {
  const double gamma = 1 + std::sqrt(0.5);
  for (const int mode : {1, 2, 5, 32}) {
    for (const double dt : {1e-6, 1e-3, 0.1, 10.0}) {
      const double z = -dt * Row::decay(mode);
      const double exact = std::pow((1 + (1 - 2 * gamma) * z) / ((1 - gamma * z) * (1 - gamma * z)), 5);
      EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::factored), exact, 1e-12) << mode << ' ' << dt;
      EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::conjugateGradients), exact, 1e-11) << mode << ' ' << dt;
    }
    const double dt = 1e-5;
    EXPECT_NEAR(Row(mode).amplitudeAfter(5, dt, Method::explicitSubsteps), std::pow(1 - dt * Row::decay(mode), 5),
                1e-12);
  }
}

TEST(DiffusionStep, IsOfSecondOrderInTime) {
  const double exact = std::exp(-0.1 * Row::decay(1));
  const double coarse = Row(1).amplitudeAfter(40, 0.0025, Method::factored) - exact;
  const double fine = Row(1).amplitudeAfter(80, 0.00125, Method::factored) - exact;
  EXPECT_GT(std::fabs(coarse), 1e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.2);
}

// No mode may turn over, however long the step: not even those that Phi's slope, at most 1, makes slower than the
// matrix takes them for.
TEST(DiffusionStep, NoModeChangesItsSign) {
  for (const double slope : {0.01, 0.3, 0.586, 0.9, 1.0}) {
    for (const int mode : {1, 5, 32}) {
      for (const double dt : {1e-4, 1e-2, 1.0, 1e4}) {
        Row row(mode);
        row.step.solve(
            row.edges, row.capacities, row.saturation, dt, [&](double s) { return slope * s; },
            [&](Values& p) { row.smooth(wetcloth::DiffusionStep::kGamma * dt, Method::factored, p); }, row.fluxes);
        const double after = row.saturation[0] - row.fluxes[0] / row.capacities[0];
        EXPECT_GE(after, 0.5 - 1e-12) << slope << ' ' << mode << ' ' << dt;
        EXPECT_LT(after, 0.9) << slope << ' ' << mode << ' ' << dt;
      }
    }
  }
}

// A drop on one node, in a step of 10^4 times the longest explicit one and in shorter ones: it stays the wettest, and
// none becomes drier than dry.
TEST(DiffusionStep, ADropStaysTheWettestPlace) {
  for (const double times : {1.0, 10.0, 100.0, 1e4}) {
    Row row(1);
    std::fill(row.saturation.begin(), row.saturation.end(), 0.0);
    row.saturation[16] = 1;
    const double dt = times * longestExplicitStep(row.edges, row.capacities);
    row.step.solve(
        row.edges, row.capacities, row.saturation, dt, [](double s) { return s; },
        [&](Values& p) { row.smooth(wetcloth::DiffusionStep::kGamma * dt, Method::factored, p); }, row.fluxes);
    double sum = 0;
    for (std::size_t i = 0; i < row.saturation.size(); ++i) {
      const double in = i > 0 ? row.fluxes[i - 1] : 0;
      const double out = i < row.fluxes.size() ? row.fluxes[i] : 0;
      row.saturation[i] += (in - out) / row.capacities[i];
      sum += row.saturation[i] * row.capacities[i];
    }
    EXPECT_NEAR(sum, row.capacities[16], 1e-15) << times;
    for (const double s : row.saturation) {
      EXPECT_GE(s, -1e-14) << times;
      EXPECT_LE(s, row.saturation[16] + 1e-12) << times;
    }
  }
}

// h^2 over the largest sum of conductances, 2 / h, in half a volume at the ends.
TEST(DiffusionSolver, KnowsTheLongestExplicitStep) {
  const Row row(1);
  EXPECT_NEAR(longestExplicitStep(row.edges, row.capacities), Row::kSpacing * Row::kSpacing / 2, 1e-15);
}

// Steps that jitter share a factor; the step is of second order all the same.
TEST(DiffusionStep, KeepsItsFactorWhileTheStepJitters) {
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
    scene.run(200, t / 200);
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
      scene.run(2500, 0.02);
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
