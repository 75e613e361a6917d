// SPDX-License-Identifier: Zlib
#include "command/fit/LeastSquares.h"

#include "command/cli/Errors.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double origin = 10;  // of the logarithms, so that steps and their bounds are of one size in all of them
constexpr double leastScatter = 1e-6;  // of the readings' range, that they are taken to be rounded to

/// The residuals as Eigen's solver asks for them: over the logarithms of the unknowns that are free.
class Residuals {
 public:
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  /// @param start  of all unknowns, > 0
  Residuals(const Predict& predict, const Readings& readings, double roughness, std::vector<double> start,
            const std::vector<bool>& isFree)
      : m_predict(predict), m_readings(readings), m_roughness(roughness), m_start(std::move(start)) {
    for (std::size_t i = 0; i < isFree.size(); ++i) {
      if (isFree[i]) m_free.push_back(i);
    }
  }

  int inputs() const { return static_cast<int>(m_free.size()); }
  int values() const { return static_cast<int>(m_readings.values.size()); }

  VectorXd atStart() const { return VectorXd::Constant(inputs(), origin); }
  std::vector<double> valuesAt(const VectorXd& logarithms) const {
    constexpr double furthest = 200;  // beyond it an exponential may overflow
    std::vector<double> values = m_start;
    for (int i = 0; i < inputs(); ++i) {
      values[m_free[static_cast<std::size_t>(i)]] *= std::exp(std::clamp(logarithms[i] - origin, -furthest, furthest));
    }
    return values;
  }

  int operator()(const VectorXd& logarithms, VectorXd& residuals) const {
    const std::vector<double> model = m_predict(valuesAt(logarithms));
    residuals.resize(values());
    for (std::size_t i = 0; i < model.size(); ++i) {
      const double uncertainty = m_readings.uncertainties.empty() ? 1 : m_readings.uncertainties[i];
      residuals[static_cast<Index>(i)] = (model[i] - m_readings.values[i]) / uncertainty;
    }
    if (!residuals.allFinite()) throw command::RunError("the model gives what is not finite");
    return 0;
  }
  int df(const VectorXd& logarithms, MatrixXd& jacobian) const {
    jacobian.resize(values(), inputs());
    VectorXd above, below;
    for (int i = 0; i < inputs(); ++i) {
      const VectorXd step = m_roughness * VectorXd::Unit(inputs(), i);
      (*this)(logarithms + step, above);
      (*this)(logarithms - step, below);
      jacobian.col(i) = (above - below) / (2 * m_roughness);
    }
    return 0;
  }

 private:
  const Predict& m_predict;
  const Readings& m_readings;
  double m_roughness;
  std::vector<double> m_start;
  std::vector<std::size_t> m_free;
};

struct Minimum {
  std::vector<double> values;
  double chiSquared;
  bool hasConverged;
};

bool isConverged(Eigen::LevenbergMarquardtSpace::Status status) {
  namespace ends = Eigen::LevenbergMarquardtSpace;
  return status == ends::RelativeReductionTooSmall || status == ends::RelativeErrorTooSmall ||
         status == ends::RelativeErrorAndReductionTooSmall || status == ends::CosinusTooSmall;
}

class Search {
 public:
  Search(const Predict& predict, const Readings& readings, double roughness)
      : m_predict(predict), m_readings(readings), m_roughness(roughness) {}

  Minimum from(const std::vector<double>& start, const std::vector<bool>& isFree) const {
    Residuals residuals(m_predict, m_readings, m_roughness, start, isFree);
    VectorXd logarithms = residuals.atStart();
    bool hasConverged = true;
    if (residuals.inputs() > 0) {
      Eigen::LevenbergMarquardt<Residuals> solver(residuals);
      solver.parameters.maxfev = fitSteps;
      solver.parameters.factor = 0.1;  // no first step further than by a factor of e
      solver.parameters.xtol = solver.parameters.ftol = 1e-3 * m_roughness;
      hasConverged = isConverged(solver.minimize(logarithms));
    }
    VectorXd left;
    residuals(logarithms, left);
    const double chiSquared = left.squaredNorm();
    if (!std::isfinite(chiSquared)) {
      throw command::RunError("chi squared is not finite, the uncertainties are too small");
    }
    return {residuals.valuesAt(logarithms), chiSquared, hasConverged};
  }

  /// With one more of the values set.
  Minimum with(const Minimum& best, std::vector<bool> isFree, std::size_t which, double value) const {
    std::vector<double> start = best.values;
    start[which] = value;
    isFree[which] = false;
    return from(start, isFree);
  }

  /// Of the logarithms of those that are free, by the linearised model.
  MatrixXd covariance(const Minimum& best, const std::vector<bool>& isFree) const {
    const Residuals residuals(m_predict, m_readings, m_roughness, best.values, isFree);
    MatrixXd jacobian;
    residuals.df(residuals.atStart(), jacobian);
    const Eigen::HouseholderQR<MatrixXd> factors(jacobian);
    const Index size = jacobian.cols();
    const MatrixXd upper = factors.matrixQR().topRows(size).triangularView<Eigen::Upper>();
    const MatrixXd inverse = upper.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(size, size));
    return inverse * inverse.transpose();
  }

  std::vector<double> modelOf(const Minimum& best) const { return m_predict(best.values); }

 private:
  const Predict& m_predict;
  const Readings& m_readings;
  double m_roughness;
};

/// What chi squared is counted in: 1 or more with stated uncertainties, else the variance of a reading.
double unitOf(double chiSquared, std::size_t freedom, const Readings& readings) {
  const double reduced = chiSquared / static_cast<double>(freedom);
  if (!readings.uncertainties.empty()) return std::max(1.0, reduced);
  const auto [least, most] = std::minmax_element(readings.values.begin(), readings.values.end());
  const double rounding = leastScatter * std::max(*most - *least, std::numeric_limits<double>::min());
  return std::max(reduced, rounding * rounding);
}

/// By how much chi squared is raised at the ends of an interval of 95 %: 4, or Student's t squared where its unit is
/// told by the readings' scatter, which few of them tell badly. Within 5 %.
double clearRaise(std::size_t freedom, const Readings& readings) {
  if (!readings.uncertainties.empty()) return 4;
  constexpr double ofFew[] = {161, 18.5, 10.1};
  return freedom <= 3 ? ofFew[freedom - 1] : 4 * (1 + 2.6 / static_cast<double>(freedom - 1));
}

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The fit as it goes: which unknowns are still free.
class Telling {
 public:
  Telling(const std::vector<Unknown>& unknowns, const Search& search, const Readings& readings)
      : m_unknowns(unknowns),
        m_search(search),
        m_readings(readings),
        m_isFree(unknowns.size(), true),
        m_estimates(unknowns.size()) {
    std::vector<double> start;
    for (const Unknown& unknown : unknowns) start.push_back(unknown.start);
    m_best = noted(search.from(start, m_isFree));
    m_least = m_best.chiSquared;
    m_unit = unitOf(m_least, freedomLeft(), readings);
    m_clear = clearRaise(freedomLeft(), readings);
  }

  /// Sets the unknown that is told worst; false when all that are free are told.
  bool settleWorst() {
    std::size_t worst = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m_unknowns.size(); ++i) {
      if (!m_isFree[i]) continue;
      const double raised = look(i);
      if (raised < least) {
        least = raised;
        worst = i;
      }
    }
    if (least > m_clear) return false;
    settle(worst);
    return true;
  }

  Fit finish() {
    const std::size_t freedom = freedomLeft();
    const double unit = unitOf(m_best.chiSquared, freedom, m_readings);
    const bool hasFree = std::find(m_isFree.begin(), m_isFree.end(), true) != m_isFree.end();
    const MatrixXd covariance = hasFree ? m_search.covariance(m_best, m_isFree) : MatrixXd();
    Index place = 0;
    for (std::size_t i = 0; i < m_unknowns.size(); ++i) {
      m_estimates[i].value = m_best.values[i];
      if (!m_isFree[i]) continue;
      m_estimates[i].standardError = m_best.values[i] * std::sqrt(unit * covariance(place, place));
      ++place;
    }
    return {m_estimates, m_search.modelOf(m_best), m_best.chiSquared / static_cast<double>(freedom), m_haveConverged};
  }

 private:
  Minimum noted(const Minimum& minimum) {
    m_haveConverged = m_haveConverged && minimum.hasConverged;
    return minimum;
  }
  Minimum with(std::size_t which, double value) { return noted(m_search.with(m_best, m_isFree, which, value)); }
  std::size_t freedomLeft() const {
    return m_readings.values.size() - static_cast<std::size_t>(std::count(m_isFree.begin(), m_isFree.end(), true));
  }
  double raisedBy(std::size_t which, double value) {
    return (with(which, value).chiSquared - m_best.chiSquared) / m_unit;
  }
  /// By how much the less of half and twice the value raises chi squared.
  double look(std::size_t which) {
    m_estimates[which].fitted = m_best.values[which];
    const double half = raisedBy(which, m_best.values[which] / 2);
    const double twice = raisedBy(which, m_best.values[which] * 2);
    m_estimates[which].isNotLess = half > m_clear;
    m_estimates[which].isNotMore = twice > m_clear;
    return std::min(half, twice);
  }
  void settle(std::size_t which) {
    const double usual = m_unknowns[which].usual;
    const Minimum atUsual = with(which, usual);
    m_estimates[which].isUsual = atUsual.chiSquared - m_least <= m_clear * m_unit;
    m_best = m_estimates[which].isUsual ? atUsual : with(which, m_best.values[which]);
    m_isFree[which] = false;
  }

  const std::vector<Unknown>& m_unknowns;
  const Search& m_search;
  const Readings& m_readings;
  std::vector<bool> m_isFree;
  std::vector<Estimate> m_estimates;
  Minimum m_best;
  bool m_haveConverged = true;
  // With all of them free, so that several usual values together do not fit worse than one may.
  double m_least;
  double m_unit;
  double m_clear;
};

}  // namespace

Fit fitLeastSquares(const std::vector<Unknown>& unknowns, const Predict& predict, const Readings& readings,
                    double roughness) {
  if (readings.values.size() <= unknowns.size()) {
    throw command::InputError(counted(unknowns.size(), "number") + " cannot be fitted to " +
                              counted(readings.values.size(), "reading") + ", there must be more");
  }
  const Search search(predict, readings, roughness);
  Telling telling(unknowns, search, readings);
  while (telling.settleWorst()) {
  }
  return telling.finish();
}

}  // namespace fit
