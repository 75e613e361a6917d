// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

namespace command {

using wetcloth::CollisionAudit;

AddEffect readCollisionAudit(JsonCursor cursor, const EffectContext&) {
  using wetcloth::collision::Tier;
  static const std::vector<std::pair<std::string, Tier>> tiers{
      {"fast", Tier::fast}, {"conservative", Tier::conservative}, {"exact", Tier::exact}};
  cursor.expectObject(keys::collisionAudit);
  CollisionAudit::Parameters parameters;
  if (const auto self = cursor.find("self")) parameters.self = self->boolean();
  if (const auto others = cursor.find("others")) parameters.others = others->boolean();
  if (const auto tier = cursor.find("tier")) parameters.tier = tier->choice(tiers);
  return addEffect<CollisionAudit>(parameters);
}

}  // namespace command
