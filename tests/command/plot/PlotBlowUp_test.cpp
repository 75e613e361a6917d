// SPDX-License-Identifier: Zlib
#include "command/cli/Errors.h"
#include "command/plot/FallPlot.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test::plot_blow_up_test {
namespace {

// As in FallBlowUp_test.cpp the case is made up: a wind that carries the cloth off faster than anything falls.
TEST(PlotBlowUp, AFallThatBlowsUpIsNoPlot) {
  command::FallMode mode = command::FallMode::physical();
  mode.air.velocity = btVector3(0, btScalar(1e4), 0);
  try {
    command::descend(mode, {"made up", 1, true});
    FAIL() << "it is a plot";
  } catch (const command::RunError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("wetcloth: the cloth blew up after ", 0), 0u) << error.what();
  }
}

TEST(PlotBlowUp, ASoundFallIsOne) {
  const command::FallMode mode = command::FallMode::physical();
  EXPECT_GT(command::descend(mode, mode.cases.back()).x.size(), 5u);
}

}  // namespace
}  // namespace wetcloth_test::plot_blow_up_test
