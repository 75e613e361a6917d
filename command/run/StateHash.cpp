// SPDX-License-Identifier: Zlib
#include "command/run/StateHash.h"

#include <cstdint>
#include <cstdio>
#include <cstring>

namespace command {
namespace {

class Fnv1a {
 public:
  template <class Number>
  void add(Number number) {
    unsigned char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    for (const unsigned char byte : bytes) m_hash = (m_hash ^ byte) * 0x100000001b3ull;
  }
  void add(const btVector3& vector) {  // not its fourth number, which means nothing
    add(vector.x());
    add(vector.y());
    add(vector.z());
  }
  std::uint64_t value() const { return m_hash; }

 private:
  std::uint64_t m_hash = 0xcbf29ce484222325ull;
};

}  // namespace

std::string stateHash(const SceneWorld& world) {
  Fnv1a hash;
  for (const btSoftBody* body : world.bodies()) {
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      hash.add(body->m_nodes[i].m_x);
      hash.add(body->m_nodes[i].m_v);
    }
  }
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    for (int i = 0; i < cloth->nodeCount(); ++i) hash.add(cloth->held(i));
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

}  // namespace command
