// SPDX-License-Identifier: Zlib
// Equal states are equal bytes: what Bullet never sets is not written. Two processes that are alike but for what their
// memory held before build the same world, and save it.

#include "tests/state/FurnishedScene.h"
#include "tests/state/StateScene.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#if defined(__GLIBC__)

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace wetcloth_test::equal_bytes_test {
namespace {

using state_scene::Case;
using state_scene::FurnishedScene;
using state_scene::StateScene;
using state_scene::Story;

// What a function finds on the stack that does not set its variables.
void dirtyStack(unsigned char byte) {
  volatile unsigned char bytes[100000];
  for (volatile unsigned char& each : bytes) each = byte;
}

// What Bullet gets that is new, or used again.
unsigned char dirt = 0;
void* allocateDirty(std::size_t size) {
  void* const memory = std::malloc(size);
  return memory ? std::memset(memory, dirt, size) : nullptr;
}

template <class Scene, class Made>
std::string statesOf(const Made& what, unsigned char byte) {
  mallopt(M_PERTURB, byte);
  dirt = byte;
  btAlignedAllocSetCustom(allocateDirty, std::free);
  dirtyStack(byte);
  Scene scene(what);
  std::string states = scene.saved();
  for (const int steps : {1, 29}) {
    scene.step(steps);
    dirtyStack(byte);
    states += scene.saved();
  }
  return states;
}

[[noreturn]] void tell(int pipe, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = write(pipe, text.data() + done, text.size() - done);
    if (written <= 0) _exit(1);
    done += std::size_t(written);
  }
  _exit(0);
}

/// A process of its own that saves the scene.
class Child {
 public:
  template <class Scene, class Made>
  void start(const Made& what, unsigned char byte) {
    if (pipe(m_ends) != 0) std::abort();
    m_process = fork();
    if (m_process == 0) tell(m_ends[1], statesOf<Scene>(what, byte));
    close(m_ends[1]);
  }
  std::string said() {
    std::string text;
    char buffer[65536];
    for (ssize_t size = 0; (size = read(m_ends[0], buffer, sizeof buffer)) > 0;) text.append(buffer, std::size_t(size));
    close(m_ends[0]);
    int status = 0;
    waitpid(m_process, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? text : "the process failed";
  }

 private:
  int m_ends[2] = {};
  pid_t m_process = 0;
};

template <class Scene, class Made>
void expectEqualBytes(const Made& what) {
  // Nothing is allocated between the two: the order of addresses is part of a state.
  Child children[2];
  children[0].start<Scene>(what, 0x55);
  children[1].start<Scene>(what, 0xAA);
  const std::string first = children[0].said();
  const std::string second = children[1].said();
  ASSERT_EQ(first.size(), second.size());
  ASSERT_GT(first.size(), 1000u) << first;
  std::size_t different = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == second[i]) continue;
    if (different++ == 0) where = i;
  }
  EXPECT_EQ(different, 0u) << "of " << first.size() << " bytes; the first is " << where;
}

TEST_IN_EVERY_WORLD(EqualBytesOfACloth, WithAllThatABodyMayHave) { expectEqualBytes<FurnishedScene>(GetParam()); }
using EqualBytes = testing::TestWithParam<Case>;
TEST_P(EqualBytes, OfEqualStates) { expectEqualBytes<StateScene>(GetParam()); }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const WorldKind kind :
       {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable, WorldKind::deformableImplicit}) {
    for (const Story story : {Story::hanging, Story::onRigid, Story::onPile}) all.push_back({kind, story});
  }
  all.push_back({WorldKind::softRigid, Story::clothOnCloth});
  all.push_back({WorldKind::softMultiBody, Story::clothOnCloth});
  return all;
}

INSTANTIATE_TEST_SUITE_P(, EqualBytes, testing::ValuesIn(cases()), [](const auto& test) {
  std::ostringstream name;
  name << test.param.story << "_" << test.param.kind;
  return name.str();
});

}  // namespace
}  // namespace wetcloth_test::equal_bytes_test

#endif
