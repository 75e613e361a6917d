// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/ChildProgram.h"
#include "command/pictures/Image.h"

#include <string>

namespace pictures {

/// A film, which the program ffmpeg writes: .mp4 (H.264), .webm (VP9) or .gif, as the file's suffix says.
class FilmFile {
 public:
  /// Throws Unavailable when there is no ffmpeg.
  static void requireFfmpeg();
  /// Throws as requireFfmpeg() does.
  /// @param width, height  of every picture [pixels]; even for .mp4 and .webm
  FilmFile(const std::string& path, int width, int height, double framesPerSecond);

  // Both throw std::runtime_error with ffmpeg's last words when it has failed.
  void add(const Image& image);
  void finish();

 private:
  [[noreturn]] void fail() const;

  ChildProgram m_ffmpeg;
};

}  // namespace pictures
