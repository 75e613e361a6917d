// SPDX-License-Identifier: Zlib
#pragma once

#include <bullet_wetcloth/collision/Query.h>

#include <string>
#include <vector>

namespace command {

/// A collision query of a file, and its exact answer.
struct KnownQuery {
  std::string id;
  wetcloth::collision::Pair pair;
  bool meets;
  wetcloth::collision::Query<double> points;
};

/// Reads a file of queries, CSV that may be compressed by gzip: id, scene, vf or ee, 1 or 0 for whether they meet, and
/// 24 coordinates. Throws InputError with file, line and column for the first thing that is wrong.
std::vector<KnownQuery> readQueries(const std::string& file);

}  // namespace command
