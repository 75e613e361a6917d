// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/WorldPart.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetClothWorld.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

WorldPart::WorldPart(WetClothWorld& world) : m_world(&world) {
  world.requireAttached();
  if (world.m_part) reject("world", "has a part beside its cloths already");
  world.m_part = this;
}

WorldPart::~WorldPart() {
  if (m_world) m_world->m_part = nullptr;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
