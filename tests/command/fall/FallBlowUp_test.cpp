// SPDX-License-Identifier: Zlib
#include "command/fall/Fall.h"

#include "command/cli/Errors.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test::fall_blow_up_test {
namespace {

/// The complaint of a fall in a wind that blows straight up.
std::string complaintIn(double wind, command::WorldKind world) {
  command::FallMode mode = command::FallMode::physical();
  mode.air.velocity = btVector3(0, btScalar(wind), 0);
  try {
    command::fall(mode, {"made up", 1, true}, 1, world);
  } catch (const command::RunError& error) {
    return error.what();
  }
  return "";
}

// No option of `wetcloth fall` makes the cloth blow up: its springs are half as stiff as the explicit world bears, its
// wind is integrated semi-implicitly, its masses are those of the case, and --height only ends the fall. So the case is
// made up: a wind that carries the cloth off faster than anything falls.
TEST(FallBlowUp, IsARunThatFailedAndNamesNodeTimeAndRemedy) {
  for (const auto world :
       {command::WorldKind::softRigid, command::WorldKind::softMultiBody, command::WorldKind::deformable}) {
    const std::string complaint = complaintIn(1e4, world);
    for (const char* word : {"the cloth blew up after ", " s: node ", "--world"}) {
      EXPECT_NE(complaint.find(word), std::string::npos) << word << ": " << complaint;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::fall_blow_up_test
