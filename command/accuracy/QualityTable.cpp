// SPDX-License-Identifier: Zlib
#include "command/accuracy/QualityTable.h"

#include "command/accuracy/Advice.h"
#include "command/accuracy/Study.h"
#include "command/scene/Quality.h"

#include <cstdio>

namespace accuracy {

std::vector<QualityRow> qualityRows(const nlohmann::json& measured) {
  const std::vector<command::MeasuredPoint> points = command::readMeasuredPoints(measured);
  std::vector<QualityRow> rows;
  for (const char* const elasticity : {"Bullet's links", "HookeSprings", "deformable, implicit"}) {
    const std::vector<command::StudyOfScene> studies{{"cloth_sag", elasticity},
                                                     {"cloth_period", elasticity},
                                                     {"wind_quadratic", "semi-implicit"},
                                                     {"absorption", "exact, exposure at the start"},
                                                     {"diffusion", "factored"}};
    for (const auto& [name, quality] : command::qualityNames()) {
      const double allowed = command::allowedError(quality);
      command::SteppingChoice choice = command::cheapestStepping(studies, allowed, points);
      if (choice.substep > 0) rows.push_back({name, allowed, elasticity, choice});
    }
  }
  return rows;
}

nlohmann::ordered_json jsonOf(const std::vector<QualityRow>& rows) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const QualityRow& row : rows) {
    nlohmann::ordered_json errors;
    for (const auto& expectation : row.choice.expected) errors[expectation.study.study] = expectation.error;
    json.push_back({{"name", row.quality},
                    {"allowed_error", row.allowedError},
                    {"elasticity", row.elasticity},
                    {"substep_s", row.choice.substep},
                    {"iterations", row.choice.iterations},
                    {"us_per_node_second", row.choice.time},
                    {"errors", errors}});
  }
  return json;
}

std::string markdownOf(const std::vector<QualityRow>& rows) {
  if (rows.empty()) return "";
  std::string text = "| quality | cloth by | substep | iterations | us per node and simulated second |";
  for (const auto& expectation : rows.front().choice.expected) text += " " + expectation.study.study + " |";
  text += "\n|---|---|---|---|---|";
  for (std::size_t i = 0; i < rows.front().choice.expected.size(); ++i) text += "---|";
  text += "\n";
  for (const QualityRow& row : rows) {
    char cells[240];
    const std::string iterations = row.choice.iterations > 0 ? std::to_string(row.choice.iterations) : "its own";
    std::snprintf(cells, sizeof cells, "| %s | %s | %s | %s | %.3g |", row.quality.c_str(), row.elasticity.c_str(),
                  stepLabel(row.choice.substep).c_str(), iterations.c_str(), row.choice.time);
    text += cells;
    for (const auto& expectation : row.choice.expected) text += " " + errorText(expectation.error) + " |";
    text += "\n";
  }
  return text;
}

}  // namespace accuracy
