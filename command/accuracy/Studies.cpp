// SPDX-License-Identifier: Zlib
#include "command/accuracy/Studies.h"

namespace accuracy {

const std::vector<std::pair<std::string, CarryOutStudies>>& studyNames() {
  static const std::vector<std::pair<std::string, CarryOutStudies>> names{{"absorption", studyAbsorption},
                                                                          {"diffusion", studyDiffusion},
                                                                          {"splitting", studySplitting},
                                                                          {"wind", studyWind},
                                                                          {"pace", studyPace},
                                                                          {"cloth", studyCloth},
                                                                          {"mesh", studyMesh},
                                                                          {"collision", studyCollision},
                                                                          {"guard", studyGuard},
                                                                          {"measurement", studyMeasurement},
                                                                          {"paper", studyPaper}};
  return names;
}

}  // namespace accuracy
