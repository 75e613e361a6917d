// SPDX-License-Identifier: Zlib
// A program that was compiled with other settings than the library hears so, and not of its world.

#include "tests/support/ClothScene.h"

#include "bullet_wetcloth/Layout.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

namespace wetcloth_test::layout_test {

namespace {

TEST(Layout, OfThisProgramIsTheLibrarys) {
  EXPECT_NO_THROW(wetcloth::requireLayout(wetcloth::kLayout, wetcloth::kLayout));
}

TEST(Layout, ThatDiffersIsNamed) {
  wetcloth::Layout debug = wetcloth::kLayout;
  debug.vector = 56;  // of -D_GLIBCXX_DEBUG
  const std::string reason = rejection([&] { wetcloth::requireLayout(debug, wetcloth::kLayout); });
  EXPECT_NE(reason.find("sizeof(std::vector) in the program = 56: must be 24 as in the library"), std::string::npos)
      << reason;
  EXPECT_NE(reason.find("_GLIBCXX_DEBUG"), std::string::npos) << reason;
}

}  // namespace
}  // namespace wetcloth_test::layout_test
