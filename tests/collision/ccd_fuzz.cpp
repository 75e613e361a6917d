// SPDX-License-Identifier: Zlib
// ccd_fuzz N [SEED]: N generated queries, every tier against exact arithmetic. Counts on stdout, progress on stderr;
// the first misses as hex floats. Exit code 1 when any tier misses a contact or the exact one is wrong.

#include "tests/support/QueryGenerator.h"
#include "tests/support/QueryJudge.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>

namespace wetcloth_test {
namespace {

constexpr std::size_t kBatch = 64;
constexpr int kShownOfAKind = 5;

struct Tally {
  long long asked = 0;
  long long contacts = 0;
  long long faults = 0;
  long long falseAlarms = 0;  ///< of the conservative tier
};

struct Run {
  Tally tallies[2][std::size(kQueryClasses)];
  long long done = 0;
  long long faults = 0;
  std::map<std::string, long long> kinds;  ///< of faults, by tier
};

void report(Run& run, Tally& tally, const std::string& kind, const std::string& query) {
  ++tally.faults;
  ++run.faults;
  if (run.kinds[kind]++ < kShownOfAKind) std::cout << kind << ": " << query << std::endl;
}

template <class Scalar>
void judgeOneBatch(Run& run, Tally& tally, QueryGenerator& generator, QueryClass kind, Pair pair) {
  std::vector<Query<Scalar>> queries;
  for (std::size_t i = 0; i < kBatch; ++i) queries.push_back(generator.next<Scalar>(kind, pair));
  std::vector<Tier> tiers = {Tier::fast, Tier::conservative};
  if (ContinuousCheck::hasExact()) tiers.push_back(Tier::exact);
  Contact contacts[3][kBatch];
  for (std::size_t tier = 0; tier < tiers.size(); ++tier)
    ContinuousCheck{tiers[tier]}(pair, queries.data(), kBatch, contacts[tier]);

  const char* const names[] = {"fast batch", "conservative batch", "exact batch"};
  for (std::size_t i = 0; i < kBatch; ++i) {
    ++tally.asked;
    const Verdict verdict = verdictOn(pair, queries[i]);
    tally.contacts += verdict.meets ? 1 : 0;
    if (contacts[1][i].found && !verdict.meets) ++tally.falseAlarms;
    for (std::size_t tier = 0; tier < tiers.size(); ++tier) {
      const std::string fault = faultOf(tiers[tier], pair, queries[i], contacts[tier][i], verdict);
      if (!fault.empty()) {
        report(run, tally, std::string(names[tier]) + " " + fault,
               std::string(nameOf(kind)) + " " + literal(pair, queries[i]));
      }
    }
  }
}

int fuzz(long long count, std::uint64_t seed) {
  Run run;
  QueryGenerator generator(seed);
  const auto began = std::chrono::steady_clock::now();
  double told = 0;
  for (long long round = 0; run.done < count; ++round) {
    for (std::size_t kind = 0; kind < std::size(kQueryClasses) && run.done < count; ++kind) {
      const Pair pair = round % 2 == 0 ? Pair::vertexFace : Pair::edgeEdge;
      Tally& tally = run.tallies[round % 2][kind];
      if (round / 2 % 3 == 0) {
        judgeOneBatch<float>(run, tally, generator, kQueryClasses[kind], pair);
      } else {
        judgeOneBatch<double>(run, tally, generator, kQueryClasses[kind], pair);
      }
      run.done += kBatch;
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      if (seconds > told + 10) {
        told = seconds;
        std::cerr << run.done << " of " << count << " after " << static_cast<long long>(seconds) << " s, " << run.faults
                  << " faults" << std::endl;
      }
    }
  }

  std::printf("%-12s %-11s %10s %10s %14s %8s\n", "pair", "class", "queries", "contacts", "false alarms", "faults");
  for (int pair = 0; pair < 2; ++pair) {
    for (std::size_t kind = 0; kind < std::size(kQueryClasses); ++kind) {
      const Tally& tally = run.tallies[pair][kind];
      std::printf("%-12s %-11s %10lld %10lld %14lld %8lld\n", pair == 0 ? "vertexFace" : "edgeEdge",
                  nameOf(kQueryClasses[kind]), tally.asked, tally.contacts, tally.falseAlarms, tally.faults);
    }
  }
  for (const auto& [kind, faults] : run.kinds) std::printf("%lld x %s\n", faults, kind.c_str());
  std::printf("%lld queries, seed %llu, %lld faults\n", run.done, static_cast<unsigned long long>(seed), run.faults);
  return run.faults == 0 ? 0 : 1;
}

}  // namespace
}  // namespace wetcloth_test

int main(int argc, char** argv) {
  const long long count = argc > 1 ? std::atoll(argv[1]) : 0;
  if (argc > 3 || count <= 0) {
    std::cerr << "usage: ccd_fuzz N [SEED]" << std::endl;
    return 2;
  }
  return wetcloth_test::fuzz(count, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
}
