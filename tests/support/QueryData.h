// SPDX-License-Identifier: Zlib
#pragma once

// The collision queries of tests/data/ccd with their exact answers.

#include <bullet_wetcloth/collision/Query.h>

#include <zlib.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace wetcloth_test {

struct KnownQuery {
  std::string id;
  std::string scene;
  wetcloth::collision::Pair pair;
  bool meets;  ///< the exact answer
  wetcloth::collision::Query<double> points;
};

inline KnownQuery readKnownQuery(const std::string& line) {
  std::istringstream fields(line);
  KnownQuery query;
  std::string field;
  std::getline(fields, query.id, ',');
  std::getline(fields, query.scene, ',');
  std::getline(fields, field, ',');
  query.pair = field == "vf" ? wetcloth::collision::Pair::vertexFace : wetcloth::collision::Pair::edgeEdge;
  std::getline(fields, field, ',');
  query.meets = field == "1";
  for (auto* points : {&query.points.start, &query.points.end}) {
    for (auto& point : *points) {
      for (double& coordinate : point) {
        if (!std::getline(fields, field, ',')) throw std::runtime_error("short line: " + line);
        coordinate = std::strtod(field.c_str(), nullptr);
      }
    }
  }
  return query;
}

inline std::vector<KnownQuery> readKnownQueries(const std::string& collection) {
  const std::string path = std::string(WETCLOTH_SOURCE_DIR) + "/tests/data/ccd/" + collection + "_queries.csv.gz";
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) throw std::runtime_error("cannot open " + path);
  std::vector<KnownQuery> queries;
  char line[4096];
  gzgets(file, line, sizeof line);  // the header
  while (gzgets(file, line, sizeof line) != nullptr) queries.push_back(readKnownQuery(line));
  gzclose(file);
  if (queries.empty()) throw std::runtime_error("nothing in " + path);
  return queries;
}

/// All queries of one collection: "real" or "cloth". Read once: some tests ask a hundred times.
inline const std::vector<KnownQuery>& knownQueries(const std::string& collection) {
  static std::map<std::string, std::vector<KnownQuery>> read;
  const auto known = read.find(collection);
  return known != read.end() ? known->second : read.emplace(collection, readKnownQueries(collection)).first->second;
}

}  // namespace wetcloth_test
