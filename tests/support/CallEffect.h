// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/WetCloth.h"

#include <functional>
#include <memory>
#include <utility>

namespace wetcloth_test {

/// Calls `function` once per substep, as an effect of the application's own.
class Call : public wetcloth::Effect {
 public:
  using Function = std::function<void(wetcloth::WetCloth&, const wetcloth::Step&)>;
  explicit Call(Function function, wetcloth::Stage stage = wetcloth::Stage::forces)
      : m_function(std::move(function)), m_stage(stage) {}
  const char* name() const override { return "Call"; }
  wetcloth::Stage stage() const override { return m_stage; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override { m_function(cloth, step); }

 private:
  Function m_function;
  wetcloth::Stage m_stage;
};

inline wetcloth::Effect& addCall(wetcloth::WetCloth& cloth, Call::Function function,
                                 wetcloth::Stage stage = wetcloth::Stage::forces) {
  return cloth.add(std::make_unique<Call>(std::move(function), stage));
}

}  // namespace wetcloth_test
