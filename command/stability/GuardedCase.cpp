// SPDX-License-Identifier: Zlib
#include "command/stability/GuardedCase.h"

#include "command/stability/CaseScene.h"

#include <utility>
#include <vector>

namespace stability {
namespace {

using Guard = wetcloth::ClothSolver::Guard;

/// Tells what an audit of each small step saw, and whether the guard had to give up.
class Witness {
 public:
  explicit Witness(CaseScene& scene) : m_scene(scene) {
    for (const CaseScene::Cloth& cloth : scene.cloths()) {
      if (wetcloth::CollisionAudit* const audit = scene.audit(*cloth.body)) m_audits.push_back(audit);
    }
  }

  void lookAtTheLastStep() const {
    for (wetcloth::CollisionAudit* const audit : m_audits) audit->look();
  }
  void tell(CaseMeter& meter) const {
    wetcloth::AuditTotals seen;
    for (wetcloth::CollisionAudit* const audit : m_audits) {
      seen.vertexFace += audit->totals().vertexFace;
      seen.edgeEdge += audit->totals().edgeEdge;
      seen.incompleteSubsteps += audit->totals().incompleteSubsteps;
    }
    meter.compare("passages", static_cast<double>(seen.passages()), 0);
    if (!m_scene.isOurs()) return;
    const wetcloth::ClothSolver::GuardTotals guard = m_scene.clothSolver()->guardTotals();
    meter.compare("unseen steps", static_cast<double>(seen.incompleteSubsteps), 0);
    meter.compare("halts", static_cast<double>(guard.halts), 0);
  }

 private:
  CaseScene& m_scene;
  std::vector<wetcloth::CollisionAudit*> m_audits;
};

}  // namespace

HardCase guarded(std::string name, std::string about, const Guard& guard, std::function<Script(CaseScene&)> build) {
  HardCase hardCase;
  hardCase.name = std::move(name);
  hardCase.group = "guard";
  hardCase.about = std::move(about);
  hardCase.worlds = {World::softRigidGuard};
  hardCase.naiveMethod = "no guard";
  hardCase.build = [guard, build = std::move(build)](CaseScene& scene) {
    scene.guardBy(guard);
    scene.limits.whip = 6;
    Script script = build(scene);
    if (scene.isPlainBullet()) return script;
    const auto witness = std::make_shared<Witness>(scene);
    script.observe = [witness, observe = script.observe](CaseMeter& meter) {
      witness->tell(meter);
      if (observe) observe(meter);
    };
    script.finish = [witness, finish = script.finish](CaseMeter& meter) {
      witness->lookAtTheLastStep();
      witness->tell(meter);
      if (finish) finish(meter);
    };
    return script;
  };
  return hardCase;
}

btSoftBody& addCloth(CaseScene& scene, std::unique_ptr<btSoftBody> cloth) {
  btSoftBody& body = scene.add(std::move(cloth), 1000);
  scene.collide(body);
  body.getCollisionShape()->setMargin(btScalar(0.01));
  body.m_cfg.kDP = btScalar(0.002);
  return body;
}

btSoftBody& addCloth(CaseScene& scene, const wetcloth::ClothPatch& patch) {
  return addCloth(scene, patch.build(scene.worldInfo()));
}

}  // namespace stability
