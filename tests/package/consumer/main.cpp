// SPDX-License-Identifier: Zlib
#include <bullet_wetcloth/bullet_wetcloth.h>

#include <cstdio>

int main() {
  const wetcloth::Fabric fabric = wetcloth::Fabric::cotton();
  std::printf("capacity %g, float%d\n", fabric.capacity, static_cast<int>(8 * sizeof(btScalar)));
  return 0;
}
