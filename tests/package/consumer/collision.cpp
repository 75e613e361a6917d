// SPDX-License-Identifier: Zlib
// An application that has no Bullet.
#include <bullet_wetcloth/collision/ContinuousCheck.h>
#include <bullet_wetcloth/collision/CoplanarityCubic.h>

using namespace wetcloth::collision;

int main() {
  const Query<float> query{{{0, 0, 1}, {1, 0, 1}, {0.5f, -1, 0}, {0.5f, 1, 0}},
                           {{0, 0, -1}, {1, 0, -1}, {0.5f, -1, 0}, {0.5f, 1, 0}}};
  Contact contacts[1];
  const ContinuousCheck check(Tier::fast);
  check(Pair::edgeEdge, &query, 1, contacts);
  return contacts[0].found && !coplanarityCubic(query).hasNoRoot() ? 0 : 1;
}
