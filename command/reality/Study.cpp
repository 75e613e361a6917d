// SPDX-License-Identifier: Zlib
#include "command/reality/Study.h"

#include "command/cli/Errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace reality {
namespace {

/// Takes errors of single readings together.
class ErrorSum {
 public:
  void add(double error, double uncertainty) {
    ++m_readings;
    m_sum += error;
    m_squares += error * error;
    m_ofUncertainty += error * error / (uncertainty * uncertainty);
  }
  Errors over(double range) const {
    if (m_readings == 0) return {};
    const double rootMeanSquare = std::sqrt(m_squares / m_readings);
    return {m_readings, rootMeanSquare, rootMeanSquare / range, std::sqrt(m_ofUncertainty / m_readings),
            m_sum / m_readings / range};
  }

 private:
  int m_readings = 0;
  double m_sum = 0;
  double m_squares = 0;
  double m_ofUncertainty = 0;
};

/// Calls action(sample, reading) for each reading that is fitted, or for each that is not.
template <class Action>
void forEachReading(const std::vector<Sample>& samples, bool isFitted, Action action) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t k = 0; k < samples[i].at.size(); ++k) {
      if (samples[i].isFitted[k] == isFitted) action(i, k);
    }
  }
}

double rangeOfReadings(const Plan& plan) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const std::vector<Sample>& samples : plan.groups) {
    for (const Sample& sample : samples) {
      for (const double reading : sample.measured) {
        least = std::min(least, reading);
        most = std::max(most, reading);
      }
    }
  }
  return most - least;
}

fit::Fit fitParameter(const Plan& plan, const std::vector<Sample>& samples) {
  fit::Readings readings;
  forEachReading(samples, true, [&](std::size_t i, std::size_t k) {
    readings.values.push_back(samples[i].measured[k]);
    readings.uncertainties.push_back(samples[i].uncertainty[k]);
  });
  const fit::Predict predict = [&](const std::vector<double>& unknowns) {
    std::vector<double> model;
    for (const Sample& sample : samples) {
      if (std::find(sample.isFitted.begin(), sample.isFitted.end(), true) == sample.isFitted.end()) continue;
      const std::vector<double> all = sample.run(unknowns[0]);
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (sample.isFitted[k]) model.push_back(all[k]);
      }
    }
    return model;
  };
  try {
    return fit::fitLeastSquares({{plan.parameter, plan.start, plan.start}}, predict, readings, plan.roughness);
  } catch (const command::RunError& error) {
    throw command::RunError("wetcloth: " + plan.parameter + ": " + error.what());
  }
}

ErrorSum errorsOf(const std::vector<Sample>& samples, const Group& group, bool isFitted, ErrorSum sum = {}) {
  forEachReading(samples, isFitted, [&](std::size_t i, std::size_t k) {
    sum.add(group.model[i][k] - samples[i].measured[k], samples[i].uncertainty[k]);
  });
  return sum;
}

}  // namespace

Study carryOut(const Plan& plan, const TellProgress& tell) {
  Study study;
  study.plan = plan;
  const double range = rangeOfReadings(plan);
  ErrorSum fitted, predicted;
  for (const std::vector<Sample>& samples : plan.groups) {
    Group group;
    const fit::Fit fit = fitParameter(plan, samples);
    group.parameter = fit.estimates.front();
    group.hasConverged = fit.hasConverged;
    for (const Sample& sample : samples) group.model.push_back(sample.run(group.parameter.value));
    group.fitted = errorsOf(samples, group, true).over(range);
    group.predicted = errorsOf(samples, group, false).over(range);
    fitted = errorsOf(samples, group, true, fitted);
    predicted = errorsOf(samples, group, false, predicted);
    study.groups.push_back(group);
    tell(static_cast<double>(study.groups.size()) / static_cast<double>(plan.groups.size()));
  }
  study.fitted = fitted.over(range);
  study.predicted = predicted.over(range);
  return study;
}

}  // namespace reality
