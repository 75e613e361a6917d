// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Colouring.h"
#include "command/pictures/FrameSequence.h"

#include <string>
#include <vector>

namespace pictures {

/// Which number has which place, from 0 to 1, in the map of colours. It grows to the values that it is shown, up to
/// the next round number, so that a colour means the same in a whole film.
class ColourScale {
 public:
  explicit ColourScale(Colouring colouring);

  Colouring colouring() const { return m_colouring; }
  void include(const Frame& frame);
  /// One per node, in [0, 1]; empty for Colouring::fabric.
  std::vector<float> placesOf(const ClothState& state) const;

  float low() const { return m_low; }
  float high() const { return m_high; }
  /// What is measured, with its unit.
  std::string title() const;
  /// From low to high, as many as stand well beside a bar.
  std::vector<std::string> labels() const;

 private:
  Colouring m_colouring;
  float m_low = 0;
  float m_high = 1;
};

}  // namespace pictures
