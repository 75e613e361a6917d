// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

namespace wetcloth_test {

/// A test that is a function
class FunctionTest : public testing::Test {
 public:
  explicit FunctionTest(void (*body)()) : m_body(body) {}

 private:
  void TestBody() override { m_body(); }

  void (*m_body)();
};

inline bool addTest(const char* suite, const char* name, const char* file, int line, void (*body)()) {
  testing::RegisterTest(suite, name, nullptr, nullptr, file, line,
                        [body]() -> testing::Test* { return new FunctionTest(body); });
  return true;
}

}  // namespace wetcloth_test

// GoogleTest's own makes a class and a factory of each test: ten functions, and 5 ms of compiling. All else is as it is
// there, so a file that is compiled without this header is the same tests.
#undef TEST
#define TEST(suite, name)                                                                 \
  static void suite##_##name##_Test();                                                    \
  [[maybe_unused]] static const bool suite##_##name##_added =                             \
      ::wetcloth_test::addTest(#suite, #name, __FILE__, __LINE__, suite##_##name##_Test); \
  static void suite##_##name##_Test()
