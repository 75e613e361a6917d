// SPDX-License-Identifier: Zlib
// Runs every scene of examples/scenes for a moment and compares the hash of what it came to with the stored one; some
// of them also on ClothSolver, which comes to the same with every set of instructions in all of them:
//   state-hashes-PRECISION STORED.json SCENE.json... [--write]
// --write stores the hashes instead. Exit status 0: as stored; 1: not so; 77: not so, but neither are the compiler and
// the C library those of the stored ones, and so there is nothing to compare.

#include "command/run/StateHash.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"

#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "bullet_wetcloth/state/StateHash.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

namespace {

using Json = nlohmann::ordered_json;
using wetcloth_test::BulletWorld;
using wetcloth_test::WorldKind;

constexpr int kSteps = 24;
constexpr int kFirstSteps = 6;  // enough to show that a run depends on what the process did before
constexpr int kSkipped = 77;

std::string hexadecimal(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

/// The C library chooses between versions of its functions by the processor, and they may differ in the last digit.
std::string hashOfMathFunctions() {
  wetcloth::StateHash hash;
  for (int i = 1; i < 2000; ++i) {
    const double x = 0.0137 * i;
    for (const double value : {std::exp(-x), std::expm1(-x), std::pow(x, 1.7), std::sin(x), std::cos(x), std::log(x)}) {
      hash.add(&value, sizeof value);
    }
    const float y = static_cast<float>(x);
    for (const float value : {std::exp(-y), std::pow(y, 1.7f), std::sin(y), std::cos(y)}) {
      hash.add(&value, sizeof value);
    }
  }
  return hexadecimal(hash.value());
}

/// Kinds of machines that come to results of their own.
constexpr const char* kMachine =
#if defined(__x86_64__) || defined(_M_X64)
    "x86_64";
#elif defined(__aarch64__) || defined(_M_ARM64)
    "aarch64";
#else
    "other";
#endif

/// What a patch of plain Bullet's comes to that hangs and swings: who builds Bullet chooses whether it multiplies and
/// adds in one operation.
std::string hashOfBullet() {
  wetcloth::StateHash hash;
  for (const WorldKind kind : {WorldKind::softRigid, WorldKind::deformable}) {
    BulletWorld bullet(kind);
    const std::unique_ptr<btSoftBody> patch(
        btSoftBodyHelpers::CreatePatch(bullet.info(), btVector3(0, 0, 0), btVector3(btScalar(0.7), 0, btScalar(0.1)),
                                       btVector3(0, 0, 1), btVector3(btScalar(0.7), 0, 1), 10, 10, 1 + 2, true));
    bullet.add(*patch);
    bullet.step(kSteps);
    const std::vector<btScalar> state = wetcloth_test::stateOf(*patch);
    hash.add(state.data(), state.size() * sizeof(btScalar));
    bullet.remove(*patch);
  }
  return hexadecimal(hash.value());
}

Json toolchain() {
  Json json;
  json["bullet"] = btGetVersion();
#ifdef __clang__
  json["compiler"] = std::string("clang ") + __clang_version__;
#elif defined(__VERSION__)
  json["compiler"] = std::string("gcc ") + __VERSION__;
#endif
#ifdef __GLIBC__
  json["libc"] = std::string("glibc ") + gnu_get_libc_version();
#endif
  json["math_functions"] = hashOfMathFunctions();
  json["plain_bullet"] = hashOfBullet();
  return json;
}

/// What a scene comes to after the first steps, and after all of them.
struct Run {
  explicit Run(const command::Scene& scene) : world(scene), afterFirst(hashAfter(kFirstSteps)) {}
  std::string hashAfter(int steps) {
    while (done < steps) {
      world.step();
      ++done;
    }
    return command::stateHash(world);
  }

  command::SceneWorld world;
  int done = 0;
  std::string afterFirst;
};

/// Bullet shuffles contacts of two soft bodies there by random numbers that go on from run to run in a process.
bool isSameEachTime(const command::Scene& scene) {
  if (scene.world != command::WorldKind::deformable) return true;
  bool meetsCloth = scene.cloths.size() > 1;
  for (const command::ClothScene& cloth : scene.cloths) meetsCloth = meetsCloth || cloth.selfCollision;
  return !meetsCloth;
}

struct Hashes {
  Json found;
  bool areReproducible = true;
};

void runOnBullet(const std::string& name, command::Scene scene, Hashes& hashes) {
  scene.clothSolver.reset();
  Run run(scene);
  hashes.found[name] = run.hashAfter(kSteps);
  if (!isSameEachTime(scene) || Run(scene).afterFirst == run.afterFirst) return;
  std::printf("%s: run twice in one process, it came to two states\n", name.c_str());
  hashes.areReproducible = false;
}

std::string runWith(wetcloth::InstructionSet set, const command::Scene& scene) {
  wetcloth::forceInstructionSet(set);
  const std::string hash = Run(scene).hashAfter(kSteps);
  wetcloth::forceInstructionSet(wetcloth::InstructionSet::avx2);  // the best that there is
  return hash;
}

void runOnClothSolver(const std::string& name, command::Scene scene, Hashes& hashes) {
  static const std::vector<std::string> stored{"hanging_towel", "rain_on_umbrella_cloth"};
  const bool isItsOwn = scene.clothSolver.has_value();  // with its numbers
  if (!isItsOwn) scene.clothSolver.emplace();
  const std::string hash = runWith(wetcloth::InstructionSet::baseline, scene);
  if (isItsOwn || std::find(stored.begin(), stored.end(), name) != stored.end()) {
    hashes.found[name + ", solver wetcloth"] = hash;
  }
  if (runWith(wetcloth::InstructionSet::avx2, scene) == hash) return;
  std::printf("%s, solver wetcloth: with AVX2 it came to another state\n", name.c_str());
  hashes.areReproducible = false;
}

Hashes runAll(const std::vector<std::string>& files) {
  Hashes hashes;
  for (const std::string& file : files) {
    const command::Scene scene = command::readScene(file);
    const std::string name = std::filesystem::path(file).stem().string();
    runOnBullet(name, scene, hashes);
    if (scene.world != command::WorldKind::deformable) runOnClothSolver(name, scene, hashes);
  }
  return hashes;
}

Json readStored(const std::string& path) {
  std::ifstream stream(path);
  return stream ? Json::parse(stream) : Json::object();
}

/// In the file: of this kind of machine, in this precision; null where there is nothing.
Json& storedHere(Json& all) { return all["machines"][kMachine][command::nameOf(command::ownPrecision)]; }

void write(const std::string& path, const Json& found) {
  Json all = readStored(path);
  all["steps"] = kSteps;
  storedHere(all) = {{"toolchain", toolchain()}, {"hashes", found}};
  std::ofstream(path) << all.dump(2) << '\n';
}

/// How many are not as stored.
std::size_t countDifferent(const Json& stored, const Json& found) {
  std::size_t different = 0;
  for (const auto& [name, hash] : found.items()) {
    const std::string wanted = stored.value(name, "none");
    if (wanted == hash) continue;
    std::printf("%s: %s, stored is %s\n", name.c_str(), hash.get<std::string>().c_str(), wanted.c_str());
    ++different;
  }
  return different;
}

int check(const std::string& path, const Hashes& hashes, const char* program) {
  Json all = readStored(path);
  const Json stored = storedHere(all);
  if (stored.is_null()) {
    std::printf("None are stored for a machine of the kind %s\n", kMachine);
    return hashes.areReproducible ? kSkipped : 1;
  }
  const std::size_t different = countDifferent(stored.at("hashes"), hashes.found);
  std::printf("%zu of %zu runs of %d steps are as stored\n", hashes.found.size() - different, hashes.found.size(),
              kSteps);
  if (different == 0) return hashes.areReproducible ? 0 : 1;
  const Json here = toolchain();
  if (stored.at("toolchain") != here) {
    std::printf("They were stored with %s; here it is %s: that may be all (docs/determinism.md).\n",
                stored.at("toolchain").dump().c_str(), here.dump().c_str());
    return hashes.areReproducible ? kSkipped : 1;
  }
  std::printf("If results were meant to change, store the new hashes: ./dev hashes --write (it runs %s).\n", program);
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> files;
  bool writes = false;
  for (int i = 2; i < count; ++i) {
    const std::string word = arguments[i];
    if (word == "--write") {
      writes = true;
    } else {
      files.push_back(word);
    }
  }
  if (count < 3 || files.empty()) {
    std::fprintf(stderr, "usage: %s STORED.json SCENE.json... [--write]\n", arguments[0]);
    return 2;
  }
  try {
    const Hashes hashes = runAll(files);
    if (!writes) return check(arguments[1], hashes, arguments[0]);
    write(arguments[1], hashes.found);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
