// SPDX-License-Identifier: Zlib
// Bullet's own demos, each run without us, with a WetClothWorld that has nothing to do, and with effects: the second is
// the first bit for bit, and in the third everything stays finite and the ledgers close. One line for each demo, with
// how far its ledgers are from that; exit status 1 when one of them is not so.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/state/StateHash.h"

#include <BulletSoftBody/btSoftBody.h>
#include <btBulletDynamicsCommon.h>

#include <CommonInterfaces/CommonExampleInterface.h>
#include <CommonInterfaces/CommonGUIHelperInterface.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using CreateDemo = CommonExampleInterface*(CommonExampleOptions&);
#define DEMO(name) CommonExampleInterface* name##CreateFunc(CommonExampleOptions&);
#include "demos.inc"
#undef DEMO

namespace {

struct Demo {
  std::string name;
  CreateDemo* create;
  int option = 0;
};

std::vector<Demo> demos() {
  std::vector<Demo> all = {
#define DEMO(name) {#name, name##CreateFunc},
#include "demos.inc"
#undef DEMO
  };
  constexpr int kSoftDemos = 32;  // scenes of the first one
  const Demo soft = all.front();
  all.erase(all.begin());
  for (int i = 0; i < kSoftDemos; ++i) all.push_back({soft.name + std::to_string(i), soft.create, i});
  return all;
}

/// No window; the demo hands in its world when it is built.
class NoWindow : public DummyGUIHelper {
 public:
  void autogenerateGraphicsObjects(btDiscreteDynamicsWorld* world) override { m_world = world; }
  btDiscreteDynamicsWorld* world() { return m_world; }

 private:
  btDiscreteDynamicsWorld* m_world = nullptr;
};

enum class Company { none, idle, effects };

std::vector<btSoftBody*> softBodiesOf(btDiscreteDynamicsWorld& world) {
  std::vector<btSoftBody*> bodies;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    if (btSoftBody* const body = btSoftBody::upcast(world.getCollisionObjectArray()[i])) bodies.push_back(body);
  }
  return bodies;
}

/// Unless it refuses the body: a rope has no triangles, and Bullet does not list the contacts of every body.
template <class Effect>
void offer(wetcloth::WetCloth& cloth) {
  try {
    cloth.add<Effect>();
  } catch (const std::invalid_argument&) {
  }
}

void addEffects(wetcloth::WetCloth& cloth) {
  offer<wetcloth::Absorption>(cloth);
  offer<wetcloth::Diffusion>(cloth);
  offer<wetcloth::Dripping>(cloth);
  offer<wetcloth::Drying>(cloth);
  offer<wetcloth::WetFriction>(cloth);
  offer<wetcloth::Cling>(cloth);
}

std::unique_ptr<wetcloth::WetClothWorld> accompany(btDiscreteDynamicsWorld& world, Company company) {
  if (company == Company::none) return nullptr;
  auto wet = std::make_unique<wetcloth::WetClothWorld>(world);
  wet->setLog(nullptr);
  for (btSoftBody* const body : softBodiesOf(world)) {
    wetcloth::WetCloth& cloth = wet->add(*body);
    if (company == Company::effects) addEffects(cloth);
  }
  return wet;
}

/// As a share of the water, or of a gram where there is less.
double imbalanceOf(const wetcloth::Ledger& ledger) {
  return std::fabs(ledger.imbalance()) / std::max(1e-3, ledger.initial + ledger.absorbed);
}

/// What a demo came to: a hash of all nodes' motion, whether it is finite, the worst ledger; no error is all right.
struct End {
  unsigned long long hash = 0xcbf29ce484222325u;
  bool isFinite = true;
  double imbalance = 0;
  char error[200] = "";
};

End run(const Demo& demo, Company company) {
  std::srand(1);
  NoWindow window;
  CommonExampleOptions options(&window, demo.option);
  CommonExampleInterface* const example = demo.create(options);  // not destroyed: the process ends here
  example->initPhysics();
  const auto wet = accompany(*window.world(), company);
  for (int i = 0; i < 60; ++i) example->stepSimulation(1.f / 60);
  End end;
  wetcloth::StateHash hash;
  for (const btSoftBody* const body : softBodiesOf(*window.world())) {
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      for (const btVector3& v : {body->m_nodes[i].m_x, body->m_nodes[i].m_v}) {
        end.isFinite = end.isFinite && std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
        hash.add(v.m_floats, 3 * sizeof(btScalar));
      }
    }
  }
  end.hash = hash.value();
  if (wet) {
    for (const wetcloth::WetCloth& cloth : wet->cloths()) {
      const double imbalance = imbalanceOf(cloth.ledger());
      if (!(imbalance <= end.imbalance)) end.imbalance = imbalance;  // what is not a number is the worst
    }
  }
  return end;
}

[[noreturn]] void tell(int pipe, const Demo& demo, Company company) {
  End end;
  try {
    end = run(demo, company);
  } catch (const std::exception& error) {
    std::snprintf(end.error, sizeof end.error, "%s", error.what());
  }
  _exit(write(pipe, &end, sizeof end) == ssize_t(sizeof end) ? 0 : 1);
}

// Bullet's random numbers go on from demo to demo within a process.
End inProcess(const Demo& demo, Company company) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) tell(ends[1], demo, company);
  close(ends[1]);
  End end;
  if (read(ends[0], &end, sizeof end) != ssize_t(sizeof end)) std::snprintf(end.error, sizeof end.error, "it crashed");
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return end;
}

struct Verdict {
  bool isFault;
  std::string text;
};

Verdict judge(const Demo& demo, const End& alone) {
  if (alone.error[0] != '\0') return {false, std::string("skipped; Bullet alone: ") + alone.error};
  const End idle = inProcess(demo, Company::idle);
  if (idle.error[0] != '\0') return {true, std::string("without effects: ") + idle.error};
  if (idle.hash != alone.hash) return {true, "without effects it is not what Bullet alone comes to"};
  const End wet = inProcess(demo, Company::effects);
  if (wet.error[0] != '\0') return {true, std::string("with effects: ") + wet.error};
  if (alone.isFinite && !wet.isFinite) return {true, "with effects it is not finite"};
  char ledger[40];
  std::snprintf(ledger, sizeof ledger, "ledger within %.1e", wet.imbalance);
  if (!(wet.imbalance <= 1e-12)) return {true, std::string("does not close: ") + ledger};
  return {false, std::string("as it should be, ") + ledger};
}

}  // namespace

int main() {
  int faults = 0;
  for (const Demo& demo : demos()) {
    const Verdict verdict = judge(demo, inProcess(demo, Company::none));
    std::printf("%-26s %s\n", demo.name.c_str(), verdict.text.c_str());
    std::fflush(stdout);
    if (verdict.isFault) ++faults;
  }
  return faults == 0 ? 0 : 1;
}
