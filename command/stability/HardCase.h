// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseMeter.h"
#include "command/stability/World.h"

#include <functional>
#include <string>
#include <vector>

namespace stability {

class CaseScene;

/// What happens to a case's scene while it runs. Any of them may be empty.
struct Script {
  std::function<void()> before = {};             ///< before each step: what forces the cloth
  std::function<void()> advance = {};            ///< instead of one Bullet step of the scene's dt
  std::function<void(CaseMeter&)> finish = {};   ///< after the last step: bounds of this case alone
  std::function<void(CaseMeter&)> observe = {};  ///< after each step: the same
};

/// Something that is known to break cloth, and how long it is to be borne.
struct HardCase {
  std::string name;
  std::string group;
  std::string about;  ///< one line for the table
  std::vector<World> worlds;
  double duration = 3;       ///< [s]
  double quickDuration = 0;  ///< of a quick run of the table; 0: no shorter [s]
  int steps = 0;             ///< instead, where it is they that count; 0: as many as the duration has, and 60 at least
  int quickSteps = 0;        ///< of a quick run of the table; 0: no fewer
  bool isWeightless = false;
  bool comparesAlways = true;  ///< plain Bullet is run, too; else only where ours does not hold
  /// Fills the scene, sets its limits and says what goes on in it. The same bodies for each Way.
  std::function<Script(CaseScene&)> build = {};
  /// Of a case without a world: computes and compares.
  std::function<void(Way, CaseMeter&)> compute = {};
  std::string naiveMethod = {};  ///< what one would write first, when it is run beside ours
  /// Steps that it is run at [s]; empty: all of the table.
  std::vector<double> stepSizes = {};
};

}  // namespace stability
