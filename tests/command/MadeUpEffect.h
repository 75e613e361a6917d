// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/EffectCatalogue.h"
#include "command/scene/ReadParameters.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <memory>

namespace command {

/// An effect that no library has: dew, which gives each node water in each step.
class Dew : public wetcloth::Effect {
 public:
  struct Parameters {
    double water = 1e-6;  ///< [kg] for a node in a step
  };

  explicit Dew(const Parameters& parameters) : m_parameters(parameters) {}

  const char* name() const override { return "Dew"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void setParameters(const Parameters& parameters) { m_parameters = parameters; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step&) override {
    for (std::size_t i = 0; i < cloth.water().size(); ++i) cloth.water().absorb(i, m_parameters.water, 0, 0, 0);
  }

 private:
  Parameters m_parameters;
};

/// All that the command needs to be told of it.
inline EffectEntry dew() {
  EffectEntry entry;
  entry.key = "dew";
  entry.about = "falls at night";
  entry.keys = {"dew", {"water_kg"}};
  entry.read = [](const JsonCursor& cursor, const EffectContext&) {
    Dew::Parameters parameters;
    readNumber(cursor, "water_kg", Range::positive(), parameters.water);
    return addEffect<Dew>(parameters);
  };
  entry.byDefault = addDefault<Dew>;
  entry.needs.water = true;
  entry.water = WaterRole::brings;
  return entry;
}

inline EffectCatalogue catalogueWithDew() {
  EffectCatalogue catalogue = effectCatalogue();
  catalogue.push_back(dew());
  return catalogue;
}

}  // namespace command
