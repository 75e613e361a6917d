// SPDX-License-Identifier: Zlib
// Several that touch one side of a node have together what the one that would have most would have alone.

#include "bullet_wetcloth/numerics/SideShares.h"

#include <gtest/gtest.h>

namespace wetcloth_test::side_shares_test {
namespace {

using wetcloth::SideShares;
using Side = SideShares::Side;

TEST(SideShares, OneAloneHasAll) {
  SideShares shares;
  shares.reset(2);
  for (const double wanted : {0.1, 0.2, 0.7}) shares.add(1, Side::front, 0, wanted);
  EXPECT_EQ(shares.share(1, Side::front), 1);
  EXPECT_EQ(shares.share(0, Side::front), 1) << "nobody is there";
}

TEST(SideShares, OfKAlikeEachHasOneKth) {
  for (const int k : {2, 3, 7}) {
    SideShares shares;
    shares.reset(1);
    for (int who = 0; who < k; ++who) {
      for (int contact = 0; contact < 4; ++contact) shares.add(0, Side::back, who, 0.25);
    }
    EXPECT_DOUBLE_EQ(shares.share(0, Side::back), 1.0 / k);
  }
}

TEST(SideShares, TogetherTheyHaveWhatTheGreatestHasAlone) {
  SideShares shares;
  shares.reset(1);
  shares.add(0, Side::front, 0, 1);
  shares.add(0, Side::front, 1, 2);
  shares.add(0, Side::front, 1, 2);
  shares.add(0, Side::front, 2, 3);
  EXPECT_DOUBLE_EQ((1 + 4 + 3) * shares.share(0, Side::front), 4);
}

TEST(SideShares, WhoWantsNothingTakesNoShare) {
  SideShares shares;
  shares.reset(1);
  shares.add(0, Side::front, 0, 1);
  shares.add(0, Side::front, 1, 0);
  EXPECT_EQ(shares.share(0, Side::front), 1);
}

TEST(SideShares, SidesKnowNothingOfEachOther) {
  SideShares shares;
  shares.reset(1);
  shares.add(0, Side::front, 0, 1);
  shares.add(0, Side::back, 1, 1);
  shares.add(0, Side::back, 2, 1);
  EXPECT_EQ(shares.share(0, Side::front), 1);
  EXPECT_EQ(shares.share(0, Side::back), 0.5);
  shares.reset(1);
  EXPECT_EQ(shares.share(0, Side::back), 1);
  const btVector3 up(0, 1, 0);
  EXPECT_EQ(SideShares::sideOf(up, btVector3(1, 1, 0)), Side::front);
  EXPECT_EQ(SideShares::sideOf(up, btVector3(1, -1, 0)), Side::back);
}

}  // namespace
}  // namespace wetcloth_test::side_shares_test
