// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"

namespace command {

const std::vector<std::pair<std::string, MakePlots>>& plotNames() {
  static const std::vector<std::pair<std::string, MakePlots>> names{{"mass", massPlots},
                                                                    {"fall", fallPlots},
                                                                    {"fps", fpsPlots},
                                                                    {"wicking", wickingPlots},
                                                                    {"springs", springsPlots}};
  return names;
}

}  // namespace command
