// SPDX-License-Identifier: Zlib
// What cannot be restored is refused with a message that says why, and nothing of the world has changed by then.

#include "tests/state/StateScene.h"

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/state/StateEnvelope.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace wetcloth_test::refusal_test {
namespace {

using state_scene::Case;
using state_scene::refusal;
using state_scene::StateScene;
using state_scene::Story;

constexpr std::size_t kEnvelope = 48;  // bytes before the state itself
const Case kCase = {WorldKind::softRigid, Story::onRigid};

class StateRefusal : public testing::Test {
 protected:
  StateRefusal() : m_scene(kCase) {
    m_scene.step(30);
    m_state = m_scene.saved();
    m_scene.step(3);
    m_before = m_scene.saved();
  }
  /// Refused, for a reason that says this, and the live world is as it was.
  void expectRefused(const std::string& state, const std::string& reason) {
    const std::string message = refusal(m_scene, state);
    EXPECT_NE(message.find(reason), std::string::npos) << '"' << message << '"';
    EXPECT_EQ(m_scene.saved(), m_before);
  }

  StateScene m_scene;
  std::string m_state;
  std::string m_before;
};

TEST_F(StateRefusal, OfAStreamThatIsCutOffAnywhere) {
  for (std::size_t length = 0; length < m_state.size(); length += length < 200 ? 1 : 211) {
    const std::string message = refusal(m_scene, m_state.substr(0, length));
    const char* const reason = length == 0 ? "no saved state" : "cut off";
    EXPECT_NE(message.find(reason), std::string::npos) << length << ": " << message;
  }
  expectRefused(m_state.substr(0, m_state.size() - 1),
                "cut off: " + std::to_string(m_state.size() - 1) + " bytes of " + std::to_string(m_state.size()));
}

TEST_F(StateRefusal, OfAStreamWithAnyByteChanged) {
  for (std::size_t place = 0; place < m_state.size(); place += place < 200 ? 1 : 101) {
    std::string changed = m_state;
    changed[place] = static_cast<char>(changed[place] ^ (1 << (place % 8)));
    EXPECT_NE(refusal(m_scene, changed), "") << "byte " << place;
  }
  EXPECT_EQ(m_scene.saved(), m_before);
  m_state[m_state.size() / 2] = static_cast<char>(m_state[m_state.size() / 2] ^ 0x10);
  expectRefused(m_state, "changed");
}

TEST_F(StateRefusal, OfWhatIsNoSavedState) {
  expectRefused("", "no saved state");
  expectRefused("{\"world\": \"deformable\"}", "no saved state");
  expectRefused(std::string(1000, '\0'), "no saved state");
}

// Whatever a stream holds, what is said of it is one line that a terminal shows as it is.
TEST_F(StateRefusal, InOneLine) {
  std::string state = m_state.substr(kEnvelope);
  const std::size_t name = state.find("WetFriction");
  ASSERT_NE(name, std::string::npos);
  state[name] = '\n';
  state[name + 1] = '\x1b';
  std::ostringstream stream;
  wetcloth::StateEnvelope::write(stream, static_cast<std::uint32_t>(m_scene.bullet().world().getWorldType()),
                                 std::vector<unsigned char>(state.begin(), state.end()));
  expectRefused(stream.str(), "??tFriction");
}

// Of the bytes that are named in StateEnvelope.cpp: the hash is looked at last.
TEST_F(StateRefusal, NamesAnotherVersionAndPrecision) {
  std::string other = m_state;
  other[12] = 77;
  expectRefused(other, "format version is 77; here it is " + std::to_string(wetcloth::StateEnvelope::kVersion));
  other = m_state;
  other[20] = kIsDouble ? 4 : 8;
  expectRefused(other, "precision");
  other = m_state;
  other[16] = static_cast<char>(other[16] + 1);
  expectRefused(other, "version of Bullet");
}

TEST_F(StateRefusal, OfAnotherWorld) {
  StateScene other({WorldKind::softMultiBody, Story::onRigid});
  expectRefused(other.saved(), "kind of world");
  StateScene another({WorldKind::softRigid, Story::clothOnCloth});
  expectRefused(another.saved(), "the number of collision objects is 3 here and 2 in the saved state");
}

TEST_F(StateRefusal, OfOtherEffects) {
  StateScene other(kCase);
  other.cloth().add<wetcloth::Swelling>();
  expectRefused(other.saved(), "a cloth's number of effects is 6 here and 7 in the saved state");
  StateScene another(kCase);
  another.cloth().remove(another.cloth().effects()[2]);
  another.cloth().add<wetcloth::Seepage>();
  expectRefused(another.saved(), "an effect's name is \"Diffusion\" here and \"Seepage\" in the saved state");
}

TEST_F(StateRefusal, OfABodyWithOtherNodes) {
  m_scene.cloth().body().appendNode(btVector3(0, 0, 0), 1);
  m_before = m_scene.saved();
  expectRefused(m_state, "number of nodes is 82 here and 81 in the saved state");
}

// The stream may hold other things before and after it.
TEST_F(StateRefusal, LeavesTheRestOfTheStream) {
  std::istringstream stream("before " + m_state + " after");
  std::string word;
  stream >> word;
  stream.get();
  m_scene.wet().restore(stream);
  stream >> word;
  EXPECT_EQ(word, "after");
  EXPECT_EQ(m_scene.saved(), m_state);
}

TEST_F(StateRefusal, OfAStreamThatCannotBeWritten) {
  std::ostringstream stream;
  stream.setstate(std::ios::badbit);
  EXPECT_THROW(m_scene.wet().save(stream), wetcloth::StateError);
}

// A stream may have been told to throw: what is said is the same.
TEST_F(StateRefusal, OfAStreamThatThrows) {
  const std::string before = m_scene.saved();
  for (const std::size_t length : {std::size_t(0), m_state.size() / 2}) {
    std::istringstream stream(m_state.substr(0, length));
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    EXPECT_THROW(m_scene.wet().restore(stream), wetcloth::StateError);
    EXPECT_TRUE(m_scene.saved() == before);
  }
  std::ostream nowhere(nullptr);
  nowhere.clear();
  nowhere.exceptions(std::ios::failbit);
  EXPECT_THROW(m_scene.wet().save(nowhere), wetcloth::StateError);
}

}  // namespace
}  // namespace wetcloth_test::refusal_test
