// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

namespace reality {

const std::vector<StudyEntry>& studyEntries() {
  static const std::vector<StudyEntry> entries{
      {"absorption", "absorption_10s_handwoven_towels_2009", planAbsorption},
      {"wicking", "wicking_sock_knits_jasper_2025", planWicking},
      {"wicking_balance", "wicking_sock_knits_jasper_2025", planWickingInBalance},
      {"wicking_knit", "wicking_sock_knits_jasper_2025", planWickingOfAKnit},
      {"shirts", "drying_shirts_piotrowski", planShirts},
      {"other_shirt", "drying_shirts_piotrowski", planOtherShirt},
      {"towels", "drying_towel_times_hut_2023", planTowels},
      {"squares", "fall_paper_squares_sypt_2016", planSquares},
      {"sheet", "fall_a4_sheet_2013", planSheet},
      {"streamers", "streamer_drag_niskanen_2013", planStreamers}};
  return entries;
}

}  // namespace reality
