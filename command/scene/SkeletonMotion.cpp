// SPDX-License-Identifier: Zlib
#include "command/scene/SkeletonMotion.h"

#include "command/cli/Errors.h"
#include "command/scene/Trial.h"

#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace command {
namespace {

constexpr std::size_t mostFrames = 1000000;
constexpr double mostMetres = 1e6;

[[noreturn]] void rejectJoint(const aiString& name, const std::string& what) {
  throw std::invalid_argument("joint \"" + std::string(name.C_Str()) + "\"" + what);
}

bool isSound(double metres) { return std::fabs(metres) < mostMetres; }  // not where it is no number
bool isSound(const aiVector3D& p) { return isSound(p.x) && isSound(p.y) && isSound(p.z); }
bool isSound(const btVector3& p) { return isSound(p.x()) && isSound(p.y()) && isSound(p.z()); }
bool isSound(const btTransform& place) {
  const btMatrix3x3& turn = place.getBasis();
  return isSound(place.getOrigin()) && isSound(turn[0]) && isSound(turn[1]) && isSound(turn[2]);
}

template <class Key, class IsSound>
void requireSound(const aiString& joint, const Key* keys, unsigned count, const char* what,
                  const IsSound& valueIsSound) {
  for (unsigned k = 0; k < count; ++k) {
    const std::string frame = ", frame " + std::to_string(k) + ": its ";
    if (!std::isfinite(keys[k].mTime)) rejectJoint(joint, frame + "time must be a finite number");
    if (!valueIsSound(keys[k].mValue)) rejectJoint(joint, frame + what + " must be a finite number");
  }
}

void requireSound(const aiNodeAnim& channel) {
  requireSound(channel.mNodeName, channel.mPositionKeys, channel.mNumPositionKeys, "place",
               [](const aiVector3D& p) { return isSound(p); });
  requireSound(channel.mNodeName, channel.mRotationKeys, channel.mNumRotationKeys, "turn", [](const aiQuaternion& q) {
    return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
  });
}

/// 0 is what assimp says of a file that names none.
double ticksPerSecond(const aiAnimation& animation) {
  const double rate = animation.mTicksPerSecond;
  if (rate == 0) return 25;
  if (!(rate > 0 && std::isfinite(rate))) throw std::invalid_argument("the time of a frame must be a positive number");
  return rate;
}

/// What keys tell at this time, between two of them in between.
template <class Key, class Mix>
auto valueAt(const Key* keys, unsigned count, double time, Mix mix) {
  const Key* const next =
      std::upper_bound(keys, keys + count, time, [](double t, const Key& k) { return t < k.mTime; });
  if (next == keys) return keys[0].mValue;
  if (next == keys + count) return keys[count - 1].mValue;
  return mix(next[-1].mValue, next->mValue,
             static_cast<ai_real>((time - next[-1].mTime) / (next->mTime - next[-1].mTime)));
}

/// Without scale: bones are rigid.
btTransform rigid(const aiQuaternion& turn, const aiVector3D& place) {
  return btTransform(btQuaternion(btScalar(turn.x), btScalar(turn.y), btScalar(turn.z), btScalar(turn.w)).normalized(),
                     btVector3(btScalar(place.x), btScalar(place.y), btScalar(place.z)));
}

btVector3 plain(const aiVector3D& v) { return btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)); }

class SkeletonReader {
 public:
  SkeletonReader(const aiScene& scene, const Placement& placement) : m_scene(scene), m_placement(placement) {}

  SkeletonMotion read() {
    if (m_scene.mNumAnimations == 0) throw std::invalid_argument("has no motion: no animation is in it");
    const aiAnimation& animation = *m_scene.mAnimations[0];
    const std::set<double> ticks = ticksOf(animation);
    const double perSecond = ticksPerSecond(animation);
    for (const double tick : ticks) m_motion.times.push_back((tick - *ticks.begin()) / perSecond);
    for (const double tick : ticks) take(*m_scene.mRootNode, outermost(), tick);
    addSkin();
    return std::move(m_motion);
  }

 private:
  std::set<double> ticksOf(const aiAnimation& animation) {
    std::set<double> ticks;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const aiNodeAnim& channel = *animation.mChannels[c];
      requireSound(channel);
      m_channels[channel.mNodeName.C_Str()] = &channel;
      for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) ticks.insert(channel.mRotationKeys[k].mTime);
      for (unsigned k = 0; k < channel.mNumPositionKeys; ++k) ticks.insert(channel.mPositionKeys[k].mTime);
    }
    if (ticks.empty()) throw std::invalid_argument("has no motion: its animation has no frames");
    if (ticks.size() > mostFrames) throw std::invalid_argument("has more than 1000000 frames");
    return ticks;
  }

  /// Of the scene: turned and moved as it is placed; lengths are scaled where they are read.
  btTransform outermost() const {
    const auto put = [&](double x, double y, double z) {
      const auto p = m_placement({x / m_placement.scale, y / m_placement.scale, z / m_placement.scale});
      return btVector3(btScalar(p[0]), btScalar(p[1]), btScalar(p[2]));
    };
    const btVector3 origin = put(0, 0, 0);
    const btVector3 x = put(1, 0, 0) - origin, y = put(0, 1, 0) - origin, z = put(0, 0, 1) - origin;
    return btTransform(btMatrix3x3(x.x(), y.x(), z.x(), x.y(), y.y(), z.y(), x.z(), y.z(), z.z()), origin);
  }

  void take(const aiNode& node, const btTransform& parent, double tick) {
    const auto found = m_channels.find(node.mName.C_Str());
    btTransform local = placeAtRest(node);
    if (found != m_channels.end()) local = placeAt(*found->second, local, tick);
    local.setOrigin(local.getOrigin() * btScalar(m_placement.scale));
    const btTransform place = parent * local;
    if (!isSound(place)) rejectJoint(node.mName, ": its place must be a finite number");
    SkeletonMotion::Joint& joint = jointOf(node);
    joint.places.push_back(place);
    for (unsigned i = 0; i < node.mNumChildren; ++i) take(*node.mChildren[i], place, tick);
  }

  static btTransform placeAtRest(const aiNode& node) {
    aiVector3D scale, place;
    aiQuaternion turn;
    node.mTransformation.Decompose(scale, turn, place);
    return rigid(turn, place);
  }

  static btTransform placeAt(const aiNodeAnim& channel, const btTransform& rest, double tick) {
    btTransform place = rest;
    if (channel.mNumRotationKeys > 0) {
      const aiQuaternion turn = valueAt(channel.mRotationKeys, channel.mNumRotationKeys, tick,
                                        [](const aiQuaternion& a, const aiQuaternion& b, ai_real share) {
                                          aiQuaternion between;
                                          aiQuaternion::Interpolate(between, a, b, share);
                                          return between;
                                        });
      place = rigid(turn, {});
      place.setOrigin(rest.getOrigin());
    }
    if (channel.mNumPositionKeys > 0) {
      place.setOrigin(
          plain(valueAt(channel.mPositionKeys, channel.mNumPositionKeys, tick,
                        [](const aiVector3D& a, const aiVector3D& b, ai_real share) { return a + (b - a) * share; })));
    }
    return place;
  }

  SkeletonMotion::Joint& jointOf(const aiNode& node) {
    const std::string name = node.mName.C_Str();
    const auto [found, isNew] = m_numbers.emplace(&node, m_motion.joints.size());
    if (!isNew) return m_motion.joints[found->second];
    SkeletonMotion::Joint joint;
    joint.name = name;
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      joint.ends.push_back(placeAtRest(*node.mChildren[i]).getOrigin() * btScalar(m_placement.scale));
      if (!isSound(joint.ends.back())) rejectJoint(node.mName, ": the end of its bone must be a finite number");
    }
    m_byName.emplace(name, m_motion.joints.size());
    m_motion.joints.push_back(std::move(joint));
    return m_motion.joints.back();
  }

  /// Each vertex goes to the bone that holds it most.
  void addSkin() {
    for (unsigned m = 0; m < m_scene.mNumMeshes; ++m) {
      const aiMesh& mesh = *m_scene.mMeshes[m];
      std::vector<std::pair<float, const aiBone*>> holder(mesh.mNumVertices, {0.0F, nullptr});
      for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        for (unsigned w = 0; w < mesh.mBones[b]->mNumWeights; ++w) {
          const aiVertexWeight& weight = mesh.mBones[b]->mWeights[w];
          if (weight.mVertexId >= holder.size())
            rejectJoint(mesh.mBones[b]->mName, " holds a vertex that is not there");
          auto& most = holder[weight.mVertexId];
          if (weight.mWeight > most.first) most = {weight.mWeight, mesh.mBones[b]};
        }
      }
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        if (holder[v].second == nullptr) continue;
        const auto joint = m_byName.find(holder[v].second->mName.C_Str());
        if (joint == m_byName.end()) continue;
        const aiVector3D place = holder[v].second->mOffsetMatrix * mesh.mVertices[v];
        const btVector3 seen = plain(place) * btScalar(m_placement.scale);
        if (!isSound(seen)) rejectJoint(holder[v].second->mName, ": its skin must be finite numbers");
        m_motion.joints[joint->second].skin.push_back(seen);
      }
    }
  }

  const aiScene& m_scene;
  const Placement& m_placement;
  std::map<std::string, const aiNodeAnim*> m_channels;
  std::map<const aiNode*, std::size_t> m_numbers;
  std::map<std::string, std::size_t> m_byName;
  SkeletonMotion m_motion;
};

std::string wholeOf(std::ifstream& stream) {
  stream.clear();
  stream.seekg(0);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// assimp makes room for as many as a BVH file says, and goes through them, before it looks whether they are there.
void requireFramesThatFit(const std::string& text) {
  static const std::string key = "Frames:";
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    std::istringstream rest(text.substr(at + key.size(), 100));
    std::string word;
    rest >> word;
    const bool isCount = word.find_first_not_of("0123456789") == std::string::npos && word.size() < 18;
    const std::uint64_t count = isCount && !word.empty() ? std::stoull(word) : 0;
    if (count > 0 && count <= mostFrames && count <= text.size()) continue;
    throw std::invalid_argument("has \"Frames: " + shortened(word, 40) +
                                "\": must be a whole number from 1 to 1000000, and no more than are in the file");
  }
}

/// assimp goes by what is in a file and knows many formats, some of which say of a few bytes that they are gigabytes.
void requireKnownFormat(const std::string& file) {
  constexpr std::size_t headOfGlb = 12;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, stream.tellg()));
  stream.seekg(0);
  std::string start(4096, '\0');
  stream.read(&start[0], static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  if (start.compare(0, 4, "glTF") == 0 && start.size() >= headOfGlb) {
    std::uint64_t claimed = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      claimed |= static_cast<std::uint64_t>(static_cast<unsigned char>(start[8 + k])) << (8 * k);
    }
    if (claimed <= size) return;
    throw std::invalid_argument("is cut off: it says that it has " + std::to_string(claimed) + " bytes");
  }
  const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  const bool isText = first != std::string::npos;
  if (isText && start[first] == '{') return;
  if (isText && start.compare(first, 9, "HIERARCHY") == 0) return requireFramesThatFit(wholeOf(stream));
  throw std::invalid_argument("is neither BVH nor glTF, by how it begins");
}

/// One line; assimp may say nothing, and may take for a scene what has no node.
std::string complaintOf(const Assimp::Importer& importer) {
  std::string complaint = importer.GetErrorString();
  std::replace(complaint.begin(), complaint.end(), '\n', ' ');
  return complaint.empty() ? "has no joints: assimp finds no node in it" : complaint;
}

SkeletonMotion read(Assimp::Importer& importer, const std::string& file, const Placement& placement) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // no skin of its own making
  // assimp 5.2 crashes, for one, on a glTF skin without "inverseBindMatrices", which may be left out.
  if (!survivesTrial([&] { importer.ReadFile(file, 0); })) {
    throw std::invalid_argument("is something that assimp, which reads such files, crashes on");
  }
  const aiScene* const scene = importer.ReadFile(file, 0);
  if (scene == nullptr || scene->mRootNode == nullptr) throw std::invalid_argument(complaintOf(importer));
  return SkeletonReader(*scene, placement).read();
}

}  // namespace

SkeletonMotion readSkeletonMotion(const std::string& file, const Placement& placement) {
  requireKnownFormat(file);
  Assimp::Importer importer;
  try {
    return read(importer, file, placement);
  } catch (const std::bad_alloc&) {
    throw std::invalid_argument("says that it holds more than there is memory for");
  }
}

}  // namespace command
