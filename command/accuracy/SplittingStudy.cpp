// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace accuracy {
namespace {

// A strip that soaks at one end and wicks along: ds/dt = e(x) (1 - s) / theta + D s_xx, dry at first. On the chain of
// nodes that the strip's mesh is, both parts and their sum have closed forms, so that what is left is the splitting.
constexpr int chain = 33;                  // nodes along the strip of 1 m
constexpr double chainDuration = 4;        // [s]
constexpr double theta = 2;                // time constant of absorption [s]
constexpr double chainDiffusivity = 0.02;  // [m^2/s]

double exposureAt(int node) { return 0.5 + 0.5 * std::cos(pi * node / (chain - 1)); }

/// exp(t M) of a matrix that is symmetric under the nodes' capacities, by its eigenvectors.
class Exponential {
 public:
  explicit Exponential(const Eigen::MatrixXd& matrix) : m_root(chain) {
    for (int i = 0; i < chain; ++i) m_root(i) = i == 0 || i == chain - 1 ? std::sqrt(0.5) : 1;
    const Eigen::MatrixXd symmetric = m_root.asDiagonal() * matrix * m_root.cwiseInverse().asDiagonal();
    m_eigen.compute(symmetric);
  }
  Eigen::MatrixXd at(double time) const {
    const Eigen::VectorXd factors = (m_eigen.eigenvalues() * time).array().exp();
    const Eigen::MatrixXd symmetric =
        m_eigen.eigenvectors() * factors.asDiagonal() * m_eigen.eigenvectors().transpose();
    return m_root.cwiseInverse().asDiagonal() * symmetric * m_root.asDiagonal();
  }

 private:
  Eigen::VectorXd m_root;  // of the nodes' capacities: those at the ends have half a cell
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> m_eigen;
};

/// D s_xx on the chain, with edges that nothing crosses.
Eigen::MatrixXd laplacian() {
  const double scale = chainDiffusivity * (chain - 1) * (chain - 1);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(chain, chain);
  for (int i = 0; i < chain; ++i) {
    const double share = i == 0 || i == chain - 1 ? 2 : 1;
    if (i > 0) matrix(i, i - 1) = share * scale;
    if (i < chain - 1) matrix(i, i + 1) = share * scale;
    matrix(i, i) = -2 * scale;
  }
  return matrix;
}

Eigen::VectorXd soakedShares(double time) {
  Eigen::VectorXd shares(chain);
  for (int i = 0; i < chain; ++i) shares(i) = -std::expm1(-exposureAt(i) * time / theta);
  return shares;
}

/// Since s = 1 everywhere stands still, 1 - s = exp(t M) 1.
Eigen::VectorXd closedForm() {
  Eigen::MatrixXd matrix = laplacian();
  for (int i = 0; i < chain; ++i) matrix(i, i) -= exposureAt(i) / theta;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(chain);
  return ones - Exponential(matrix).at(chainDuration) * ones;
}

double largestError(const Eigen::VectorXd& saturation) {
  return (saturation - closedForm()).cwiseAbs().maxCoeff() / closedForm().maxCoeff();
}

Outcome splitExactly(bool strang, double dt) {
  const Eigen::MatrixXd wick = Exponential(laplacian()).at(dt);
  const Eigen::VectorXd soak = soakedShares(strang ? dt / 2 : dt);
  Eigen::VectorXd s = Eigen::VectorXd::Zero(chain);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(chain);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(chainDuration / dt); ++i) {
    s += soak.cwiseProduct(ones - s);
    s = (wick * s).eval();
    if (strang) s += soak.cwiseProduct(ones - s);
  }
  return {{largestError(s)}, command::processorTime() - start};
}

/// An effect of the library for a part of each step, at a stage of one's choice.
class PartOfStep : public wetcloth::Effect {
 public:
  PartOfStep(std::unique_ptr<wetcloth::Effect> effect, wetcloth::Stage stage, double share)
      : m_effect(std::move(effect)), m_stage(stage), m_share(share) {}

  const char* name() const override { return "PartOfStep"; }
  wetcloth::Stage stage() const override { return m_stage; }
  void attach(wetcloth::WetCloth& cloth) override { m_effect->attach(cloth); }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override {
    wetcloth::Step part = step;
    part.dt *= m_share;
    m_effect->apply(cloth, part);
  }

 private:
  std::unique_ptr<wetcloth::Effect> m_effect;
  wetcloth::Stage m_stage;
  double m_share;
};

std::unique_ptr<wetcloth::Effect> makeAbsorption() {
  std::vector<double> exposure;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < chain; ++i) exposure.push_back(exposureAt(i));
  }
  wetcloth::Absorption::Parameters parameters;
  parameters.exposure = std::move(exposure);
  return std::make_unique<wetcloth::Absorption>(parameters);
}

Outcome splitByTheLibrary(bool strang, double dt) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, chain);
  settings.patch.rows = 2;
  settings.patch.edgeV = btVector3(0, 0, btScalar(1. / (chain - 1)));
  settings.fabric.timeConstant = theta;
  Specimen specimen(settings);
  wetcloth::WetCloth& cloth = specimen.cloth();
  const double share = strang ? 0.5 : 1;
  cloth.add(std::make_unique<PartOfStep>(makeAbsorption(), wetcloth::Stage::sources, share));
  wetcloth::Diffusion::Parameters diffusion;
  diffusion.warpDiffusivity = diffusion.weftDiffusivity = chainDiffusivity;
  diffusion.exponent = 0;
  cloth.add<wetcloth::Diffusion>(diffusion);
  if (strang) cloth.add(std::make_unique<PartOfStep>(makeAbsorption(), wetcloth::Stage::losses, share));
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(chainDuration / dt); ++i) specimen.substepOfOurs(dt);
  const double seconds = command::processorTime() - start;
  Eigen::VectorXd s(chain);
  for (int i = 0; i < chain; ++i) s(i) = cloth.saturation(i);
  return {{largestError(s)}, seconds};
}

void addCurve(Plan& plan, const std::string& method, bool isCompared, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run) {
  Setting curve;
  curve.method = method;
  curve.nodes = isCompared ? 2 * chain : chain;
  curve.simulatedSeconds = chainDuration;
  curve.isCompared = isCompared;
  addSteps(plan, curve, steps, run);
}

}  // namespace

std::vector<Study> studySplitting(const Effort& effort, const TellProgress& tell) {
  const std::vector<double> steps =
      effort.isQuick ? std::vector<double>{1. / 60, 0.05, 0.1, 0.25}
                     : std::vector<double>{1. / 960, 1. / 240, 1. / 120, 1. / 60, 1. / 30, 0.1, 0.25, 0.5, 1};
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "our part of the step: absorption, diffusion and the commit of masses";
  plan.measures = {{"splitting", "Splitting of a step: a strip that soaks at one end and wicks",
                    "largest error of the saturation after 4 s, of the largest saturation",
                    "closed form on the same chain of nodes: 1 - exp(t M) 1"}};
  addCurve(plan, "Lie, as the library steps", true, steps, [](double dt) { return splitByTheLibrary(false, dt); });
  addCurve(plan, "Strang of the library's parts", true, steps, [](double dt) { return splitByTheLibrary(true, dt); });
  addCurve(plan, "Lie of exact parts", false, steps, [](double dt) { return splitExactly(false, dt); });
  addCurve(plan, "Strang of exact parts", false, steps, [](double dt) { return splitExactly(true, dt); });
  return carryOut(plan, effort, tell);
}

}  // namespace accuracy
