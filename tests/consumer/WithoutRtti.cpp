// SPDX-License-Identifier: Zlib
// Part of an application that is compiled without RTTI and exceptions, where the compiler can do so, and without our
// test support.
#include "tests/consumer/WithoutRtti.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <memory>

namespace consumer {
namespace {

class Sponge : public wetcloth::Effect {
 public:
  const char* name() const override { return "Sponge"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { ++m_steps; }
  int steps() const { return m_steps; }

 private:
  int m_steps = 0;
};

}  // namespace

wetcloth::Wind* Towel::wind() const { return m_cloth->find<wetcloth::Wind>(); }

bool Towel::runsAt(wetcloth::Stage stage) const {
  for (const wetcloth::Effect& effect : m_cloth->effects()) {
    if (effect.stage() == stage) return true;
  }
  return false;
}

void addSponge(wetcloth::WetCloth& cloth) { cloth.add(std::make_unique<Sponge>()); }

int stepsOfSponge(const wetcloth::WetCloth& cloth) {
  const Sponge* const sponge = cloth.find<Sponge>();
  return sponge ? sponge->steps() : -1;
}

void addRain(wetcloth::WetCloth& cloth) { cloth.add<wetcloth::Rain>(); }

}  // namespace consumer
