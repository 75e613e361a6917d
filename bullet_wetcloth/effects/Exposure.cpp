// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/Exposure.h"

#include "bullet_wetcloth/Require.h"

#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double clamped(double value) { return value > 0 ? (value < 1 ? value : 1) : 0; }  // NaN compares false: 0

}  // namespace

double Exposure::at(std::size_t node, const btVector3& position, const btVector3& normal, double time) const {
  if (const auto* const function = std::get_if<Function>(&m_value)) return clamped((*function)(position, normal));
  if (const auto* const function = std::get_if<FunctionOfTime>(&m_value)) {
    return clamped((*function)(position, normal, time));
  }
  if (const auto* const perNode = std::get_if<std::vector<double>>(&m_value)) {
    return node < perNode->size() ? (*perNode)[node] : 0;
  }
  return *std::get_if<double>(&m_value);
}

void Exposure::requireValid(const char* field) const {
  if (const auto* const constant = std::get_if<double>(&m_value)) requireFraction(field, *constant);
  const auto* const function = std::get_if<Function>(&m_value);
  const auto* const functionOfTime = std::get_if<FunctionOfTime>(&m_value);
  if ((function && !*function) || (functionOfTime && !*functionOfTime)) reject(field, "must not be an empty function");
  if (const auto* const perNode = std::get_if<std::vector<double>>(&m_value)) {
    if (perNode->empty()) rejectValue(std::string(field) + ".size()", 0, "the number of the body's nodes");
    for (std::size_t i = 0; i < perNode->size(); ++i) {
      requireFraction(std::string(field) + "[" + std::to_string(i) + "]", (*perNode)[i]);
    }
  }
}

void Exposure::requireSize(const char* field, std::size_t nodes) const {
  const auto* const perNode = std::get_if<std::vector<double>>(&m_value);
  if (perNode && perNode->size() != nodes) {
    rejectValue(std::string(field) + ".size()", perNode->size(),
                "the number of the body's nodes, " + std::to_string(nodes));
  }
}

void Exposure::requireSize(const char* field, std::size_t nodes, const Exposure& before) const {
  const auto sizeOf = [](const Exposure& exposure) {
    const auto* const perNode = std::get_if<std::vector<double>>(&exposure.m_value);
    return perNode ? perNode->size() : 0;
  };
  if (sizeOf(*this) != sizeOf(before)) requireSize(field, nodes);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
