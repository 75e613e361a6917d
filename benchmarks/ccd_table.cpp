// SPDX-License-Identifier: Zlib
// The continuous collision checks on tests/data/ccd, side by side: contacts missed, false alarms, time per query.
// Prints a table in Markdown, and the same as CSV into the file that is named.

#include <bullet_wetcloth/collision/ContinuousCheck.h>
#include <command/ccd/BulletCheck.h>
#include <command/ccd/NewtonCheck.h>
#include <command/ccd/TextbookCheck.h>
#include <tests/support/QueryData.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace {

using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

constexpr int kPasses = 9;
constexpr std::size_t kBatch = 256;  // as many as the batches of the checks themselves

double nanoseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

double quantile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  return values[std::size_t(fraction * double(values.size() - 1))];
}

/// The queries of one collection and type, in the forms that the methods take.
struct Collection {
  std::string name;
  Pair pair;
  std::vector<Query<double>> queries;
  std::vector<Query<float>> rounded;
  std::vector<command::BulletQuery> bullet;
  std::vector<char> meets;
};

Collection collect(const std::string& name, Pair pair) {
  Collection collection = {name, pair, {}, {}, {}, {}};
  for (const wetcloth_test::KnownQuery& known : wetcloth_test::knownQueries(name)) {
    if (known.pair != pair) continue;
    collection.queries.push_back(known.points);
    collection.meets.push_back(known.meets);
    Query<float> rounded;
    std::copy_n(&known.points.start[0][0], 12, &rounded.start[0][0]);
    std::copy_n(&known.points.end[0][0], 12, &rounded.end[0][0]);
    collection.rounded.push_back(rounded);
    if (pair == Pair::vertexFace) collection.bullet.emplace_back(known.points, 1.0 / 60);
  }
  return collection;
}

/// Answers queries first .. first + count - 1 into found.
using Method = std::function<void(const Collection&, std::size_t first, std::size_t count, char* found)>;

struct NamedMethod {
  std::string name;
  Method answer;
  bool edges = true;     ///< answers edge-edge queries
  bool batches = false;  ///< timed in batches
};

Method ofEach(std::function<bool(const Collection&, std::size_t)> answer) {
  return [answer](const Collection& collection, std::size_t first, std::size_t count, char* found) {
    for (std::size_t i = 0; i < count; ++i) found[i] = answer(collection, first + i);
  };
}

Method tier(Tier which) {
  return ofEach([check = ContinuousCheck(which)](const Collection& c, std::size_t i) {
    return check(c.pair, c.queries[i]).found;
  });
}

Method batches(Tier which) {
  return [check = ContinuousCheck(which)](const Collection& c, std::size_t first, std::size_t count, char* found) {
    Contact contacts[kBatch];
    check(c.pair, &c.queries[first], count, contacts);
    for (std::size_t i = 0; i < count; ++i) found[i] = contacts[i].found;
  };
}

std::vector<NamedMethod> methods() {
  std::vector<NamedMethod> list;
  list.push_back({"fast, in batches of 256", batches(Tier::fast), true, true});
  list.push_back({"conservative", tier(Tier::conservative)});
  if (ContinuousCheck::hasExact()) {
    list.push_back({"exact", tier(Tier::exact)});
    list.push_back({"exact, in batches of 256", batches(Tier::exact), true, true});
  }
  const std::string bullets = sizeof(btScalar) == sizeof(float) ? "float32" : "float64";
  list.push_back({"Bullet's own, " + bullets,
                  ofEach([](const Collection& c, std::size_t i) { return c.bullet[i].check(); }), false});
  for (const double tolerance : {0.0, 1e-6})
    list.push_back(
        {tolerance > 0 ? "textbook, 1e-6" : "textbook, strict", ofEach([tolerance](const Collection& c, std::size_t i) {
           return command::comparison::textbookCheck(c.pair, c.queries[i], tolerance).found;
         })});
  list.push_back({"textbook, float, 1e-6", ofEach([](const Collection& c, std::size_t i) {
                    return command::comparison::textbookCheck(c.pair, c.rounded[i], 1e-6F).found;
                  })});
  list.push_back({"Newton, 1e-6", ofEach([](const Collection& c, std::size_t i) {
                    return command::comparison::newtonCheck(c.pair, c.queries[i], 1e-6).found;
                  })});
  return list;
}

struct Result {
  int misses = 0;
  int falseAlarms = 0;
  std::vector<double> passes;                 ///< mean time of a query in each pass [ns]
  std::vector<std::vector<double>> perQuery;  ///< of each query in each pass [ns]

  /// The medians over the passes: a query's own time, without what the machine did meanwhile.
  std::vector<double> medians() const {
    std::vector<double> result;
    for (const auto& times : perQuery) result.push_back(quantile(times, 0.5));
    return result;
  }
};

void count(const NamedMethod& method, const Collection& collection, Result& result) {
  char found[kBatch];
  for (std::size_t first = 0; first < collection.queries.size(); first += kBatch) {
    const std::size_t size = std::min(kBatch, collection.queries.size() - first);
    method.answer(collection, first, size, found);
    for (std::size_t i = 0; i < size; ++i) {
      result.misses += collection.meets[first + i] && !found[i];
      result.falseAlarms += !collection.meets[first + i] && found[i];
    }
  }
}

void timePass(const NamedMethod& method, const Collection& collection, Result& result) {
  char found[kBatch];
  const std::size_t size = collection.queries.size();
  result.passes.push_back(nanoseconds([&] {
                            for (std::size_t first = 0; first < size; first += kBatch)
                              method.answer(collection, first, std::min(kBatch, size - first), found);
                          }) /
                          double(size));
  if (method.batches) return;
  result.perQuery.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    // The clock itself takes some 30 ns: shared by four.
    const double time = nanoseconds([&] {
      for (int repeat = 0; repeat < 4; ++repeat) method.answer(collection, i, 1, found);
    });
    result.perQuery[i].push_back(time / 4);
  }
}

void print(const NamedMethod& method, const Collection& collection, const Result& result, std::ofstream& csv) {
  const char* type = collection.pair == Pair::vertexFace ? "vf" : "ee";
  const double mean = quantile(result.passes, 0.5);
  std::printf("| %s | %s %s | %d | %d | %.0f |", method.name.c_str(), collection.name.c_str(), type, result.misses,
              result.falseAlarms, mean);
  if (method.batches)
    std::printf(" | | |\n");
  else {
    const std::vector<double> times = result.medians();
    std::printf(" %.0f | %.0f | %.0f |\n", quantile(times, 0.5), quantile(times, 0.99), quantile(times, 1));
  }
  csv << method.name << ';' << collection.name << ' ' << type << ';' << result.misses << ';' << result.falseAlarms
      << ';' << mean << '\n';
}

/// All methods in turns, so that a busy machine disturbs them alike.
void compare(const Collection& collection, std::ofstream& csv) {
  std::vector<NamedMethod> list = methods();
  if (collection.pair == Pair::edgeEdge)
    list.erase(std::remove_if(list.begin(), list.end(), [](const NamedMethod& m) { return !m.edges; }), list.end());
  std::vector<Result> results(list.size());
  for (std::size_t m = 0; m < list.size(); ++m) count(list[m], collection, results[m]);
  for (int pass = 0; pass < kPasses; ++pass)
    for (std::size_t m = 0; m < list.size(); ++m) timePass(list[m], collection, results[m]);
  for (std::size_t m = 0; m < list.size(); ++m) print(list[m], collection, results[m], csv);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " FILE.csv\n";
    return 2;
  }
  std::ofstream csv(argv[1]);
  csv << "method;queries;misses;false alarms;ns\n";
  std::printf("| method | queries | missed | false alarms | mean ns | median | 99 %% | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const char* name : {"real", "cloth"})
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) compare(collect(name, pair), csv);
  return 0;
}
