// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace accuracy {
namespace {

// A strip that soaks at one end and wicks along: ds/dt = e(x) (1 - s) / theta + D s_xx, dry at first. On the nodes of
// the strip's mesh both parts and their sum have closed forms, so that what is left is the step's error.
constexpr int columns = 33;  // nodes along the strip of 1 m; two across it
constexpr int stripNodes = 2 * columns;
constexpr double spacing = 1. / (columns - 1);
constexpr double stripDuration = 4;        // [s]
constexpr double theta = 2;                // time constant of absorption [s]
constexpr double stripDiffusivity = 0.02;  // [m^2/s]

double exposureAt(int node) { return 0.5 + 0.5 * std::cos(pi * (node % columns) * spacing); }

Specimen makeStrip() {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, columns);
  settings.patch.rows = 2;
  settings.patch.edgeV = btVector3(0, 0, btScalar(spacing));
  settings.fabric.timeConstant = theta;
  return Specimen(settings);
}

/// A number for each node
using Vector = std::vector<double>;

/// Areas of its nodes [m^2]: as what they hold.
Vector stripAreas() {
  Specimen strip = makeStrip();
  Vector areas(stripNodes);
  for (int i = 0; i < stripNodes; ++i) areas[i] = strip.cloth().capacity(i);
  const double scale = spacing / std::accumulate(areas.begin(), areas.end(), 0.);
  for (double& area : areas) area *= scale;
  return areas;
}

/// A number for each node and each node. Of our own: Eigen's templates took longer to compile than the rest of the
/// study.
struct Matrix {
  Vector entries = Vector(static_cast<std::size_t>(stripNodes) * static_cast<std::size_t>(stripNodes));

  double* operator[](int row) { return &entries[static_cast<std::size_t>(row) * stripNodes]; }
  const double* operator[](int row) const { return &entries[static_cast<std::size_t>(row) * stripNodes]; }
};

Matrix identity() {
  Matrix matrix;
  for (int i = 0; i < stripNodes; ++i) matrix[i][i] = 1;
  return matrix;
}

Vector operator*(const Matrix& matrix, const Vector& vector) {
  Vector product(stripNodes);
  for (int i = 0; i < stripNodes; ++i) {
    product[i] = std::inner_product(vector.begin(), vector.end(), matrix[i], 0.);
  }
  return product;
}

Matrix operator*(const Matrix& left, const Matrix& right) {
  Matrix product;
  for (int i = 0; i < stripNodes; ++i) {
    double* const row = product[i];
    for (int k = 0; k < stripNodes; ++k) {
      const double factor = left[i][k];
      const double* const other = right[k];
      for (int j = 0; j < stripNodes; ++j) row[j] += factor * other[j];
    }
  }
  return product;
}

/// D s_xx on squares of two triangles, with edges that nothing crosses: cotangent weights of 1/2 for each triangle
/// along its short sides, 0 along its long one.
Matrix laplacian(const Vector& areas) {
  Matrix matrix;
  const auto connect = [&](int a, int b, double weight) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      matrix[from][to] += stripDiffusivity * weight / areas[from];
      matrix[from][from] -= stripDiffusivity * weight / areas[from];
    }
  };
  for (int i = 0; i < columns; ++i) {
    connect(i, i + columns, i == 0 || i == columns - 1 ? 0.5 : 1);
    if (i == columns - 1) continue;
    connect(i, i + 1, 0.5);
    connect(i + columns, i + 1 + columns, 0.5);
  }
  return matrix;
}

/// exp(t M) by scaling and squaring: that of t M / 2^n, which is small, by its series, and then exp(2 M) = exp(M)^2.
/// Golub and Van Loan, Matrix Computations, section 9.3.
Matrix exponential(Matrix matrix, double time) {
  double largest = 0;
  for (double& entry : matrix.entries) largest = std::max(largest, std::abs(entry *= time));
  const int squarings = std::max(0, std::ilogb(largest) + 5);
  for (double& entry : matrix.entries) entry = std::ldexp(entry, -squarings);
  // No entry is above 1/16 and no row's sum of sizes above 1/8: ten terms leave less than 1e-17.
  Matrix result = identity();
  for (int term = 10; term > 0; --term) {
    result = matrix * result;
    for (double& entry : result.entries) entry /= term;
    for (int i = 0; i < stripNodes; ++i) result[i][i] += 1;
  }
  for (int i = 0; i < squarings; ++i) result = result * result;
  return result;
}

Vector soakedShares(double time) {
  Vector shares(stripNodes);
  for (int i = 0; i < stripNodes; ++i) shares[i] = -std::expm1(-exposureAt(i) * time / theta);
  return shares;
}

/// Since s = 1 everywhere stands still, 1 - s = exp(t M) 1.
Vector closedForm() {
  Matrix matrix = laplacian(stripAreas());
  for (int i = 0; i < stripNodes; ++i) matrix[i][i] -= exposureAt(i) / theta;
  Vector saturation = exponential(matrix, stripDuration) * Vector(stripNodes, 1);
  for (double& s : saturation) s = 1 - s;
  return saturation;
}

double largestError(const Vector& saturation) {
  static const Vector exact = closedForm();
  double error = 0;
  for (int i = 0; i < stripNodes; ++i) error = std::max(error, std::abs(saturation[i] - exact[i]));
  return error / *std::max_element(exact.begin(), exact.end());
}

void soakBy(const Vector& shares, Vector& saturation) {
  for (int i = 0; i < stripNodes; ++i) saturation[i] += shares[i] * (1 - saturation[i]);
}

Outcome splitExactly(bool strang, double dt) {
  const Matrix wick = exponential(laplacian(stripAreas()), dt);
  const Vector soaked = soakedShares(strang ? dt / 2 : dt);
  Vector s(stripNodes);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(stripDuration / dt); ++i) {
    soakBy(soaked, s);
    s = wick * s;
    if (strang) soakBy(soaked, s);
  }
  return {{largestError(s)}, command::processorTime() - start};
}

/// The second half of a Strang step: what soaks after the transport.
class LateAbsorption : public wetcloth::Absorption {
 public:
  using Absorption::Absorption;
  wetcloth::Stage stage() const override { return wetcloth::Stage::losses; }
};

/// @param share  of the rate
wetcloth::Absorption::Parameters soaking(double share) {
  std::vector<double> exposure;
  for (int i = 0; i < stripNodes; ++i) exposure.push_back(share * exposureAt(i));
  wetcloth::Absorption::Parameters parameters;
  parameters.exposure = std::move(exposure);
  return parameters;
}

Outcome splitByTheLibrary(bool strang, double dt) {
  Specimen specimen = makeStrip();
  wetcloth::WetCloth& cloth = specimen.cloth();
  cloth.add<wetcloth::Absorption>(soaking(strang ? 0.5 : 1));
  wetcloth::Diffusion::Parameters diffusion;
  diffusion.warpDiffusivity = diffusion.weftDiffusivity = stripDiffusivity;
  diffusion.exponent = 0;
  cloth.add<wetcloth::Diffusion>(diffusion);
  if (strang) cloth.add<LateAbsorption>(soaking(0.5));
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(stripDuration / dt); ++i) specimen.substepOfOurs(dt);
  const double seconds = command::processorTime() - start;
  Vector s(stripNodes);
  for (int i = 0; i < stripNodes; ++i) s[i] = cloth.saturation(i);
  return {{largestError(s)}, seconds};
}

void addCurve(Plan& plan, const std::string& method, bool isCompared, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run) {
  Setting curve;
  curve.method = method;
  curve.nodes = stripNodes;
  curve.simulatedSeconds = stripDuration;
  curve.isCompared = isCompared;
  addSteps(plan, curve, steps, run);
}

}  // namespace

std::vector<Study> studySplitting(const Effort& effort, const TellProgress& tell) {
  const std::vector<double> steps =
      effort.isQuick ? std::vector<double>{1. / 480, 1. / 240, 1. / 120, 1. / 60}
                     : std::vector<double>{1. / 960, 1. / 240, 1. / 120, 1. / 60, 1. / 30, 0.1, 0.25, 0.5, 1};
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "our part of the step: absorption, diffusion and the commit of masses";
  plan.measures = {{"splitting", "Splitting of a step: a strip that soaks at one end and wicks",
                    "largest error of the saturation after 4 s, of the largest saturation",
                    "closed form on the same nodes: 1 - exp(t M) 1"}};
  addCurve(plan, "Lie, as the library steps", true, steps, [](double dt) { return splitByTheLibrary(false, dt); });
  addCurve(plan, "Strang, two absorptions of half the exposure", true, steps,
           [](double dt) { return splitByTheLibrary(true, dt); });
  addCurve(plan, "Lie of exact parts", false, steps, [](double dt) { return splitExactly(false, dt); });
  addCurve(plan, "Strang of exact parts", false, steps, [](double dt) { return splitExactly(true, dt); });
  return carryOut(plan, effort, tell);
}

}  // namespace accuracy
