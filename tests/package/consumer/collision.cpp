// SPDX-License-Identifier: Zlib
// An application that has no Bullet.
#include <bullet_wetcloth/collision/ContinuousCheck.h>
#include <bullet_wetcloth/collision/CoplanarityCubic.h>
#include <bullet_wetcloth/collision/NewtonCheck.h>
#include <bullet_wetcloth/collision/TextbookCheck.h>

using namespace wetcloth::collision;

int main() {
  const Query<float> query{{{0, 0, 1}, {1, 0, 1}, {0.5f, -1, 0}, {0.5f, 1, 0}},
                           {{0, 0, -1}, {1, 0, -1}, {0.5f, -1, 0}, {0.5f, 1, 0}}};
  Contact contacts[1];
  ContinuousCheck(Tier::fast)(Pair::edgeEdge, &query, 1, contacts);
  const bool found = contacts[0].found && newtonCheck(Pair::edgeEdge, query, 1e-6).found &&
                     textbookCheck(Pair::edgeEdge, query, 1e-6f).found;
  return found && !coplanarityCubic(query).hasNoRoot() ? 0 : 1;
}
