// SPDX-License-Identifier: Zlib
// An effect of the application's own takes part by naming what it remembers.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/state/StateScene.h"

#include <gtest/gtest.h>

namespace wetcloth_test::own_effect_test {
namespace {

using state_scene::Case;
using state_scene::refusal;
using state_scene::StateScene;
using state_scene::Story;

class Counting : public wetcloth::Effect {
 public:
  struct Parameters {
    int tooMany = 0;  // numbers that are read and were not written
  };
  explicit Counting(Parameters parameters) : m_parameters(parameters) {}
  const char* name() const override { return "Counting"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { ++m_steps; }
  void transferState(wetcloth::StateArchive& archive) override {
    archive.value(m_steps);
    for (int i = 0; i < m_parameters.tooMany; ++i) archive.value(m_steps);
  }
  int steps() const { return m_steps; }

 private:
  Parameters m_parameters;
  int m_steps = 0;
};

const Case kCase = {WorldKind::softRigid, Story::hanging};

TEST(StateOfOwnEffect, IsSavedAndRestored) {
  StateScene early(kCase);
  early.cloth().setPace(wetcloth::WaterPace::exact());
  auto& counting = early.cloth().add<Counting>();
  early.step(20);
  EXPECT_GT(counting.steps(), 20);
  StateScene late(kCase);
  auto& restored = late.cloth().add<Counting>();
  late.restore(early.saved());
  EXPECT_EQ(restored.steps(), counting.steps());
}

TEST(StateOfOwnEffect, IsRefusedByNameWhenItReadsWhatIsNotItsOwn) {
  StateScene early(kCase);
  early.cloth().add<Counting>();
  StateScene late(kCase);
  late.cloth().add<Counting>({2});
  EXPECT_NE(refusal(late, early.saved()).find("the effect Counting reads 12 bytes here and has 4"), std::string::npos)
      << refusal(late, early.saved());
}

}  // namespace
}  // namespace wetcloth_test::own_effect_test
