// SPDX-License-Identifier: Zlib
#include "command/pictures/ColourScale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pictures {
namespace {

/// The values of a cloth that the colours stand for; null for the fabric's own colours.
const std::vector<float>* valuesOf(const ClothState& state, Colouring colouring) {
  switch (colouring) {
    case Colouring::saturation: return &state.saturation;
    case Colouring::stretch: return &state.stretch;
    case Colouring::speed: return &state.speed;
    case Colouring::fabric: break;
  }
  return nullptr;
}

/// 1, 2 or 5 times a power of ten that is not less.
float roundedUp(float value) {
  const float power = std::pow(10.0F, std::floor(std::log10(value)));
  for (const float factor : {1.0F, 2.0F, 5.0F}) {
    if (value <= factor * power * 1.001F) return factor * power;
  }
  return 10 * power;
}

}  // namespace

ColourScale::ColourScale(Colouring colouring) : m_colouring(colouring) {
  if (colouring == Colouring::stretch) {
    m_low = 1;
    m_high = 1.05F;
  }
}

void ColourScale::include(const Frame& frame) {
  if (m_colouring == Colouring::fabric || m_colouring == Colouring::saturation) return;
  for (const ClothState& cloth : frame.cloths) {
    const std::vector<float>& values = *valuesOf(cloth, m_colouring);
    if (values.empty()) continue;
    const float highest = *std::max_element(values.begin(), values.end());
    if (highest > m_high && std::isfinite(highest)) m_high = m_low + roundedUp(highest - m_low);
  }
}

std::vector<float> ColourScale::placesOf(const ClothState& state) const {
  const std::vector<float>* const values = valuesOf(state, m_colouring);
  if (values == nullptr) return {};
  std::vector<float> places(*values);
  for (float& place : places) place = std::min(1.0F, std::max(0.0F, (place - m_low) / (m_high - m_low)));
  return places;
}

std::string ColourScale::title() const {
  if (m_colouring == Colouring::saturation) return "saturation [%]";
  if (m_colouring == Colouring::stretch) return "length / rest length";
  return m_colouring == Colouring::speed ? "speed [m/s]" : "";
}

std::vector<std::string> ColourScale::labels() const {
  constexpr int steps = 5;
  const float factor = m_colouring == Colouring::saturation ? 100.0F : 1.0F;
  std::vector<std::string> labels;
  for (int i = 0; i <= steps; ++i) {
    const float value = factor * (m_low + (m_high - m_low) * static_cast<float>(i) / steps);
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", static_cast<double>(value));
    labels.emplace_back(text);
  }
  return labels;
}

}  // namespace pictures
