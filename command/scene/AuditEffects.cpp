// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ReadParameters.h"

namespace command {
namespace {

using wetcloth::CollisionAudit;

AddEffect readCollisionAudit(const JsonCursor& cursor, const EffectContext&) {
  using wetcloth::collision::Tier;
  static const std::vector<std::pair<std::string, Tier>> tiers{
      {"fast", Tier::fast}, {"conservative", Tier::conservative}, {"exact", Tier::exact}};
  CollisionAudit::Parameters parameters;
  if (const auto self = cursor.find("self")) parameters.self = self->boolean();
  if (const auto others = cursor.find("others")) parameters.others = others->boolean();
  if (const auto tier = cursor.find("tier")) parameters.tier = tier->choice(tiers);
  return addEffect<CollisionAudit>(parameters);
}

EffectEntry collisionAudit() {
  EffectEntry entry;
  entry.key = "collision_audit";
  entry.about = "counts what passes through what in spite of Bullet and changes nothing; `{}` does";
  entry.keys = {"collisionAudit", {"self", "others", "tier"}};
  entry.read = readCollisionAudit;
  entry.byDefault = addDefault<CollisionAudit>;
  entry.needs.faces = true;
  return entry;
}

}  // namespace

EffectCatalogue auditEffects() { return {collisionAudit()}; }

}  // namespace command
