// SPDX-License-Identifier: Zlib
// The catalogue of effects: what it says is so, and an effect that only it knows is one like any other.

#include "command/scene/EffectCatalogue.h"
#include "command/cli/Errors.h"
#include "command/scene/BulletWorld.h"
#include "command/scene/DryScene.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"
#include "tests/command/MadeUpEffect.h"

#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

namespace wetcloth_test::effect_catalogue_test {
namespace {

using namespace command;
using cli::smallScene;
using cli::TemporaryDirectory;

/// A scene in which each effect finds what it needs.
Scene sceneForAll() {
  Scene scene;
  scene.file = "test";
  scene.water = WaterScene{0.5};
  scene.colliders.emplace_back(Sphere{btVector3(0, 0, 0), 0.1});
  command::ClothScene cloth;
  cloth.shape = wetcloth::ClothPatch();
  scene.cloths = {cloth};
  return scene;
}

/// What of a body's world and of the body is left out.
struct Lack {
  bool water = false;
  bool faces = false;
  bool links = false;
  bool contacts = false;
};

std::unique_ptr<btSoftBody> bodyWithout(const Lack& lack, btSoftBodyWorldInfo& info) {
  std::unique_ptr<btSoftBody> body = wetcloth::ClothPatch().build(info);
  if (lack.faces) body->m_faces.clear();
  if (lack.links) body->m_links.clear();
  if (lack.contacts) body->m_cfg.collisions = 0;
  return body;
}

/// Why the library refuses the effect, as the catalogue's example has it; empty: it does not.
std::string refusal(const EffectEntry& entry, const Lack& lack) {
  const Scene scene = sceneForAll();
  JsonCursor cursor(entry.example, scene.file);
  cursor.expectObject(entry.keys);
  const AddEffect add = entry.read(cursor, {scene, scene.cloths[0]});
  command::BulletWorld world(command::BulletWorld::Settings{});
  if (!lack.water) world.worldInfo().water_normal = btVector3(0, 1, 0);
  const Colliders colliders{
      &world.addStatic(std::make_unique<btSphereShape>(btScalar(0.1)), btTransform::getIdentity())};
  btSoftBody& body = world.add(bodyWithout(lack, world.worldInfo()));
  wetcloth::WetClothWorld wet(world.world());
  try {
    add(wet.add(body), colliders);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expectNeed(const EffectEntry& entry, const Lack& lack, bool needs, const char* what) {
  const std::string why = refusal(entry, lack);
  EXPECT_EQ(!why.empty(), needs) << entry.key << " without " << what << ": " << why;
}

/// "WetFriction" as "wet_friction"
std::string keyOf(const std::string& className) {
  std::string key;
  for (const char letter : className) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isupper(code) != 0 && !key.empty()) key += '_';
    key += static_cast<char>(std::tolower(code));
  }
  return key;
}

std::string textOf(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Json sceneWithDew() {
  Json scene = smallScene();
  scene["cloths"][0]["effects"] = {{"dew", {{"water_kg", 2e-6}}}};
  scene["cloths"][0]["water_pace"]["every_substeps"] = 1;
  scene["water"] = {{"level_m", -10}};
  return scene;
}

TEST(EffectCatalogue, KeysAreUnique) {
  std::set<std::string> keys;
  for (const EffectEntry& entry : effectCatalogue()) EXPECT_TRUE(keys.insert(entry.key).second) << entry.key;
}

TEST(EffectCatalogue, WhatAnEffectNeedsTheLibraryRefusesItWithout) {
  for (const EffectEntry& entry : effectCatalogue()) {
    EXPECT_EQ(refusal(entry, {}), "") << entry.key;
    expectNeed(entry, {true, false, false, false}, entry.needs.water, "water");
    expectNeed(entry, {false, true, false, false}, entry.needs.faces, "faces");
    expectNeed(entry, {false, false, true, false}, entry.needs.links, "links");
    expectNeed(entry, {false, false, false, true}, entry.needs.contacts, "contacts");
  }
}

TEST(EffectCatalogue, AnEffectIsNamedAsItsClass) {
  const Scene scene = sceneForAll();
  for (const EffectEntry& entry : effectCatalogue()) {
    if (!entry.byDefault) continue;
    Scene one = scene;
    one.cloths[0].effects = {{entry.key, entry.byDefault(one), entry.water}};
    const SceneWorld world(one);
    ASSERT_EQ(world.cloths()[0]->effects().size(), 1U) << entry.key;
    EXPECT_EQ(keyOf(world.cloths()[0]->effects()[0].name()), entry.key);
  }
}

// With WETCLOTH_WRITE_DOCS set it writes the table anew.
TEST(EffectCatalogue, IsTheTableOfTheDocumentation) {
  const std::string file = WETCLOTH_SOURCE_DIR "/docs/scenes.md";
  const std::string first = "<!-- effects -->\n";
  const std::string last = "<!-- end of effects -->\n";
  std::string text = textOf(file);
  const std::size_t begin = text.find(first) + first.size();
  const std::size_t end = text.find(last);
  ASSERT_NE(end, std::string::npos);
  const std::string table = effectTable(effectCatalogue());
  if (std::getenv("WETCLOTH_WRITE_DOCS") != nullptr) {
    std::ofstream(file) << text.substr(0, begin) << table << text.substr(end);
    return;
  }
  EXPECT_EQ(text.substr(begin, end - begin), table) << "WETCLOTH_WRITE_DOCS=1 with this test writes it anew";
}

TEST(MadeUpEffect, IsReadFromASceneAndRuns) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", sceneWithDew().dump());
  const Scene scene = readScene(file, catalogueWithDew());
  SceneWorld world(scene);
  world.step();
  const wetcloth::WetCloth& cloth = *world.cloths()[0];
  EXPECT_NEAR(cloth.ledger().absorbed, 2e-6 * cloth.nodeCount() * scene.substeps, 1e-12);
}

TEST(MadeUpEffect, IsRefusedWithoutWhatItNeedsAndWithOtherKeys) {
  const TemporaryDirectory directory;
  const auto complaintAbout = [&](const Json& scene, const EffectCatalogue& catalogue) -> std::string {
    try {
      readScene(directory.write("scene.json", scene.dump()), catalogue);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Json scene = sceneWithDew();
  EXPECT_NE(complaintAbout(scene, effectCatalogue()).find("/cloths/0/effects/dew"), std::string::npos);
  EXPECT_EQ(complaintAbout(scene, catalogueWithDew()), "");
  scene.erase("water");
  EXPECT_NE(complaintAbout(scene, catalogueWithDew()).find("/water"), std::string::npos);
  scene = sceneWithDew();
  scene["cloths"][0]["effects"]["dew"]["watr_kg"] = 1;
  EXPECT_NE(complaintAbout(scene, catalogueWithDew()).find("did you mean \"water_kg\""), std::string::npos);
}

TEST(MadeUpEffect, IsNotInTheDryScene) {
  const TemporaryDirectory directory;
  Json json = sceneWithDew();
  json["cloths"][0]["effects"]["wind"] = {{"velocity_m_s", {1, 0, 0}}};
  const Scene scene = readScene(directory.write("scene.json", json.dump()), catalogueWithDew());
  ASSERT_TRUE(scene.cloths[0].hasEffect("dew"));
  const Scene dry = dryScene(scene);
  EXPECT_FALSE(dry.cloths[0].hasEffect("dew"));
  EXPECT_TRUE(dry.cloths[0].hasEffect("wind"));
}

TEST(MadeUpEffect, IsInTheTable) {
  EXPECT_NE(effectTable(catalogueWithDew()).find("| `dew` | `water_kg` | `water` | brings | falls at night |"),
            std::string::npos);
}

TEST(DryScene, LeavesOutWhatBringsMovesOrTakesWater) {
  Scene wet = sceneForAll();
  for (const EffectEntry& entry : effectCatalogue()) {
    wet.cloths[0].effects.push_back({entry.key, {}, entry.water});
  }
  const Scene dry = dryScene(wet);
  std::set<std::string> left;
  for (const EffectScene& effect : dry.cloths[0].effects) left.insert(effect.key);
  EXPECT_EQ(left, (std::set<std::string>{"hooke_springs", "wet_stiffness", "swelling", "wind", "water_drag", "cling",
                                         "wet_friction", "collision_audit"}));
}

}  // namespace
}  // namespace wetcloth_test::effect_catalogue_test
