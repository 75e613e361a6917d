// SPDX-License-Identifier: Zlib
// No tier allocates, single or in batches; only exact integers that outgrow their place may. C++ allocations are
// counted by replacing operator new for this test program; sanitizers bring an operator new of their own, so there
// nothing is counted.

#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "tests/support/QueryData.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
bool g_counting = false;
long long g_allocations = 0;

void* counted(std::size_t size) {
  if (g_counting) ++g_allocations;
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace wetcloth_test::continuous_check_allocation_test {
namespace {

using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

template <class Work>
long long allocationsOf(const Work& work) {
  g_allocations = 0;
  g_counting = true;
  work();
  g_counting = false;
  return g_allocations;
}

TEST(ContinuousCheckAllocation, TheCounterCounts) {
  EXPECT_EQ(allocationsOf([] { ::operator delete(::operator new(8)); }), 1);
}

TEST(ContinuousCheckAllocation, NoTierAllocatesOnEitherCollection) {
  for (const char* collection : {"real", "cloth"}) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      std::vector<Query<double>> queries;
      for (const KnownQuery& known : knownQueries(collection))
        if (known.pair == pair) queries.push_back(known.points);
      std::vector<Contact> contacts(queries.size());
      for (const Tier tier : {Tier::fast, Tier::conservative, Tier::exact}) {
        if (tier == Tier::exact && !ContinuousCheck::hasExact()) continue;
        const ContinuousCheck check(tier);
        EXPECT_EQ(allocationsOf([&] {
                    for (std::size_t i = 0; i < queries.size(); ++i) contacts[i] = check(pair, queries[i]);
                  }),
                  0);
        EXPECT_EQ(allocationsOf([&] { check(pair, queries.data(), queries.size(), contacts.data()); }), 0);
      }
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_allocation_test

#endif
