// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/Lanes.h"

#include "bullet_wetcloth/numerics/BestLanes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>

namespace wetcloth_test::lanes_test {
namespace {

using wetcloth::InstructionSet;

struct Spread {
  btScalar number;
  btScalar (&numbers)[8];

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t k = 0; k < 8; k += wetcloth::kLaneCount<Lanes>) {
      wetcloth::store(numbers + k, wetcloth::everywhere<Lanes>(number));
    }
  }
};

std::array<unsigned char, sizeof(btScalar)> bytesOf(btScalar number) {
  std::array<unsigned char, sizeof number> bytes;
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

// Bit for bit, also what arithmetic would change: the sign of nothing, what is no number.
TEST(Lanes, ANumberIsTheSameInEachLane) {
  using Limits = std::numeric_limits<btScalar>;
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2}) {
    wetcloth::forceInstructionSet(set);
    for (const btScalar number : {btScalar(0), btScalar(-0.0), btScalar(0.1), Limits::infinity(), -Limits::max(),
                                  Limits::denorm_min(), Limits::quiet_NaN()}) {
      btScalar numbers[8] = {};
      wetcloth::runOnBestLanes(Spread{number, numbers});
      for (const btScalar lane : numbers) EXPECT_EQ(bytesOf(lane), bytesOf(number)) << number;
    }
  }
  wetcloth::forceInstructionSet(InstructionSet::avx2);
}

}  // namespace
}  // namespace wetcloth_test::lanes_test
