// SPDX-License-Identifier: Zlib
#include "command/pictures/PointCache2.h"

#include "command/pictures/LittleEndian.h"
#include "command/pictures/OutputFile.h"

namespace pictures {
namespace {

std::string header(std::size_t pointCount, std::size_t sampleCount) {
  constexpr int version = 1;
  constexpr float startFrame = 0;
  constexpr float framesPerSample = 1;
  std::string bytes("POINTCACHE2");
  putByte(bytes, 0);
  putInt32(bytes, version);
  putInt32(bytes, static_cast<int>(pointCount));
  putFloat(bytes, startFrame);
  putFloat(bytes, framesPerSample);
  putInt32(bytes, static_cast<int>(sampleCount));
  return bytes;
}

}  // namespace

void writePointCache(const FrameSequence& sequence, std::size_t cloth, const std::string& path) {
  OutputFile file(path);
  const std::string start = header(sequence.cloths[cloth].texture.size(), sequence.frames.size());
  file.stream().write(start.data(), static_cast<std::streamsize>(start.size()));
  for (const Frame& frame : sequence.frames) {
    std::string bytes;
    for (const Vector3& position : frame.cloths[cloth].positions) {
      for (const float x : position) putFloat(bytes, x);
    }
    file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  file.close();
}

}  // namespace pictures
