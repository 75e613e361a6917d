// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>
#include <string>
#include <utility>

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

/// Areas of its nodes [m^2]: as what they hold.
Eigen::VectorXd stripAreas() {
  Specimen strip = makeStrip();
  Eigen::VectorXd areas(stripNodes);
  for (int i = 0; i < stripNodes; ++i) areas(i) = strip.cloth().capacity(i);
  return areas * (spacing / areas.sum());
}

/// D s_xx on squares of two triangles, with edges that nothing crosses: cotangent weights of 1/2 for each triangle
/// along its short sides, 0 along its long one.
Eigen::MatrixXd laplacian(const Eigen::VectorXd& areas) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(stripNodes, stripNodes);
  const auto connect = [&](int a, int b, double weight) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      matrix(from, to) += stripDiffusivity * weight / areas(from);
      matrix(from, from) -= stripDiffusivity * weight / areas(from);
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

/// exp(t M) of a matrix that is symmetric under the nodes' areas, by its eigenvectors.
class Exponential {
 public:
  Exponential(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& areas) : m_root(areas.cwiseSqrt()) {
    m_eigen.compute(m_root.asDiagonal() * matrix * m_root.cwiseInverse().asDiagonal());
  }
  Eigen::MatrixXd at(double time) const {
    const Eigen::VectorXd factors = (m_eigen.eigenvalues() * time).array().exp();
    const Eigen::MatrixXd symmetric =
        m_eigen.eigenvectors() * factors.asDiagonal() * m_eigen.eigenvectors().transpose();
    return m_root.cwiseInverse().asDiagonal() * symmetric * m_root.asDiagonal();
  }

 private:
  Eigen::VectorXd m_root;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> m_eigen;
};

Eigen::VectorXd soakedShares(double time) {
  Eigen::VectorXd shares(stripNodes);
  for (int i = 0; i < stripNodes; ++i) shares(i) = -std::expm1(-exposureAt(i) * time / theta);
  return shares;
}

/// Since s = 1 everywhere stands still, 1 - s = exp(t M) 1.
Eigen::VectorXd closedForm() {
  const Eigen::VectorXd areas = stripAreas();
  Eigen::MatrixXd matrix = laplacian(areas);
  for (int i = 0; i < stripNodes; ++i) matrix(i, i) -= exposureAt(i) / theta;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(stripNodes);
  return ones - Exponential(matrix, areas).at(stripDuration) * ones;
}

double largestError(const Eigen::VectorXd& saturation) {
  static const Eigen::VectorXd exact = closedForm();
  return (saturation - exact).cwiseAbs().maxCoeff() / exact.maxCoeff();
}

Outcome splitExactly(bool strang, double dt) {
  const Eigen::VectorXd areas = stripAreas();
  const Eigen::MatrixXd wick = Exponential(laplacian(areas), areas).at(dt);
  const Eigen::VectorXd soak = soakedShares(strang ? dt / 2 : dt);
  Eigen::VectorXd s = Eigen::VectorXd::Zero(stripNodes);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(stripNodes);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(stripDuration / dt); ++i) {
    s += soak.cwiseProduct(ones - s);
    s = (wick * s).eval();
    if (strang) s += soak.cwiseProduct(ones - s);
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
  Eigen::VectorXd s(stripNodes);
  for (int i = 0; i < stripNodes; ++i) s(i) = cloth.saturation(i);
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
