// SPDX-License-Identifier: Zlib
#include "command/reality/StudyReport.h"

#include <cstddef>
#include <cstdio>

namespace reality {
namespace {

using Json = nlohmann::ordered_json;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[600];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

Json jsonOf(const Errors& errors) {
  return {{"readings", errors.readings},
          {"rms", errors.rootMeanSquare},
          {"rms_of_range", errors.ofRange},
          {"rms_of_uncertainty", errors.ofUncertainty},
          {"bias_of_range", errors.bias}};
}

Json jsonOf(const Sample& sample, const std::vector<double>& model) {
  Json readings = Json::array();
  for (std::size_t i = 0; i < model.size(); ++i) {
    readings.push_back({{"at", sample.at[i]},
                        {"measured", sample.measured[i]},
                        {"uncertainty", sample.uncertainty[i]},
                        {"model", model[i]},
                        {"fitted", static_cast<bool>(sample.isFitted[i])}});
  }
  return {{"name", sample.name}, {"readings", readings}};
}

Json jsonOf(const Plan& plan, const std::vector<Sample>& samples, const Group& group) {
  Json json{{plan.parameter, group.parameter.value}, {"is_told", group.parameter.isTold()}};
  if (group.parameter.isTold()) json["standard_error"] = group.parameter.standardError;
  json["converged"] = group.hasConverged;
  json["fitted"] = jsonOf(group.fitted);
  json["predicted"] = jsonOf(group.predicted);
  json["samples"] = Json::array();
  for (std::size_t i = 0; i < samples.size(); ++i) json["samples"].push_back(jsonOf(samples[i], group.model[i]));
  return json;
}

std::string nameOf(const std::vector<Sample>& samples) {
  std::string name = samples.front().name;
  if (samples.size() > 1) name += " and " + std::to_string(samples.size() - 1) + " more";
  return name;
}

std::string lineOf(const char* half, const Errors& errors) {
  return format("  %-15s %3d readings: rms %.3g, %.1f %% of the range, %.2g times the uncertainty; bias %+.1f %%\n",
                half, errors.readings, errors.rootMeanSquare, 100 * errors.ofRange, errors.ofUncertainty,
                100 * errors.bias);
}

std::string parameterText(const Plan& plan, const fit::Estimate& parameter) {
  if (!parameter.isTold()) return plan.parameter + format(" %.4g, which the data cannot tell", parameter.value);
  return plan.parameter + format(" %.4g +- %.2g", parameter.value, parameter.standardError);
}

std::string readingsText(const std::vector<Sample>& samples, const Group& group) {
  std::string text;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t k = 0; k < samples[i].at.size(); ++k) {
      text += format("    %-24s %10.4g %12.5g +- %-9.2g %12.5g  %s\n", samples[i].name.c_str(), samples[i].at[k],
                     samples[i].measured[k], samples[i].uncertainty[k], group.model[i][k],
                     samples[i].isFitted[k] ? "fitted" : "predicted");
    }
  }
  return text;
}

std::string rowOf(const std::string& name, const fit::Estimate* parameter, const Errors& fitted,
                  const Errors& predicted) {
  std::string value = parameter == nullptr ? "" : format("%.3g", parameter->value);
  if (parameter != nullptr) value += parameter->isTold() ? format(" +- %.1g", parameter->standardError) : ", not told";
  return format("| %s | %s | %.1f %% | %.2g | %.1f %% | %.2g | %+.1f %% |\n", name.c_str(), value.c_str(),
                100 * fitted.ofRange, fitted.ofUncertainty, 100 * predicted.ofRange, predicted.ofUncertainty,
                100 * predicted.bias);
}

}  // namespace

std::string verdictOn(const Study& study) {
  const double times = study.predicted.ofUncertainty;
  if (times <= 1) return "The prediction is within the data's uncertainty.";
  if (times <= 2) return "The prediction is within twice the data's uncertainty.";
  return format("The prediction is wrong by %.2g times the data's uncertainty.", times);
}

Json jsonOf(const Study& study) {
  const Plan& plan = study.plan;
  Json groups = Json::array();
  for (std::size_t i = 0; i < study.groups.size(); ++i) {
    groups.push_back(jsonOf(plan, plan.groups[i], study.groups[i]));
  }
  return {{"name", plan.name},
          {"title", plan.title},
          {"data", plan.data},
          {"model", plan.model},
          {"halves", plan.halves},
          {"uncertainty", plan.doubt},
          {"at", plan.x.column},
          {"reading", plan.y.column},
          {"parameter", plan.parameter},
          {"fitted", jsonOf(study.fitted)},
          {"predicted", jsonOf(study.predicted)},
          {"verdict", verdictOn(study)},
          {"groups", groups}};
}

std::string textOf(const Study& study) {
  const Plan& plan = study.plan;
  std::string text = plan.name + ": " + plan.title + " (" + plan.data + ")\n";
  text += "  model: " + plan.model + "\n  halves: " + plan.halves + "\n  uncertainty: " + plan.doubt + "\n";
  text += format("    %-24s %10s %12s    %-9s %12s\n", "", plan.x.column.c_str(), "measured", "", "model");
  for (std::size_t i = 0; i < study.groups.size(); ++i) {
    text += "  " + parameterText(plan, study.groups[i].parameter);
    text += study.groups[i].hasConverged ? "\n" : "; the search did not converge, other values may fit better\n";
    text += readingsText(plan.groups[i], study.groups[i]);
  }
  text += lineOf("fitted half", study.fitted) + lineOf("predicted half", study.predicted);
  return text + "  " + verdictOn(study) + "\n";
}

std::string markdownOf(const Study& study, const std::string& picture) {
  const Plan& plan = study.plan;
  std::string text = "### " + plan.name + ": " + plan.title + "\n\n";
  text += "- data: `" + plan.data + ".csv`; uncertainty: " + plan.doubt + "\n- model: " + plan.model + "\n- fitted: `" +
          plan.parameter + "`; " + plan.halves + "\n\n" + verdictOn(study) + "\n\n";
  text +=
      "| | " + plan.parameter +
      " | fitted half, of range | of uncertainty | predicted half, of range | of uncertainty | its bias, of range |\n"
      "|---|---|---|---|---|---|---|\n";
  if (study.groups.size() > 1) text += rowOf("**all**", nullptr, study.fitted, study.predicted);
  for (std::size_t i = 0; i < study.groups.size(); ++i) {
    const Group& group = study.groups[i];
    text += rowOf(nameOf(plan.groups[i]), &group.parameter, group.fitted, group.predicted);
  }
  if (!picture.empty()) text += "\n![" + plan.title + ", measured and by the model](" + picture + ")\n";
  return text + "\n";
}

}  // namespace reality
