// SPDX-License-Identifier: Zlib
#pragma once

#include "command/reality/Study.h"

#include <string>
#include <utility>
#include <vector>

namespace reality {

// Each reads a file of measurements, which is told it so that it can be another of the same columns. Throws
// command::InputError as command::MeasuredTable does.

/// Handwoven towels that soak for ten seconds: Absorption.
Plan planAbsorption(const std::string& file);
/// Height of water in hanging strips of sock knit: Diffusion and Seepage.
Plan planWicking(const std::string& file);
/// The same, with Seepage's speed kept in proportion to the diffusivity, as docs/fabrics.md says.
Plan planWickingInBalance(const std::string& file);
/// The same, with a seepage speed that is fitted to one of the cloths, without that one.
Plan planWickingOfAKnit(const std::string& file);
/// Mass of two shirts on a line: Drying, of each by how it began.
Plan planShirts(const std::string& file);
/// The same, of cotton by what wool came to.
Plan planOtherShirt(const std::string& file);
/// When pieces of towel are dry: Drying, of three towels by what three others came to.
Plan planTowels(const std::string& file);
/// Terminal speed of squares of paper: Wind.
Plan planSquares(const std::string& file);
/// Time of fall of a sheet of A4 paper, flat and folded: Wind.
Plan planSheet(const std::string& file);
/// Drag of strips that fly like flags in a wind tunnel: Wind, with ClothSolver.
Plan planStreamers(const std::string& file);

struct StudyEntry {
  std::string name;  ///< as --study says
  std::string data;  ///< name of its measurements, without ".csv"
  Plan (*plan)(const std::string& file);
};

/// In the order in which they are shown.
const std::vector<StudyEntry>& studyEntries();

}  // namespace reality
