// SPDX-License-Identifier: Zlib
#include "command/pictures/FilmFile.h"

#include "command/pictures/Unavailable.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace pictures {
namespace {

using Words = std::vector<std::string>;

// Colours are those of sRGB; players take films of unknown origin for something else.
const Words sRgbFilm{"-vf",
                     "scale=out_color_matrix=bt709:out_range=tv",
                     "-pix_fmt",
                     "yuv420p",
                     "-colorspace",
                     "bt709",
                     "-color_primaries",
                     "bt709",
                     "-color_trc",
                     "iec61966-2-1"};

// Else a .webm has a random number in it: equal pictures make equal files.
const Words sameBytes{"-fflags", "+bitexact"};

Words plus(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words encoderFor(const std::string& suffix) {
  if (suffix == ".mp4") {
    return plus({"-c:v", "libx264", "-preset", "medium", "-crf", "18", "-movflags", "+faststart"}, sRgbFilm);
  }
  if (suffix == ".webm") {
    return plus(
        {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1"},
        sRgbFilm);
  }
  return {"-filter_complex",
          "split[a][b];[a]palettegen=stats_mode=diff[palette];"
          "[b][palette]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle"};
}

Words commandFor(const std::string& path, int width, int height, double framesPerSecond) {
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.6g", framesPerSecond);
  const Words input{"ffmpeg",
                    "-hide_banner",
                    "-loglevel",
                    "error",
                    "-y",
                    "-f",
                    "rawvideo",
                    "-pixel_format",
                    "rgb24",
                    "-video_size",
                    std::to_string(width) + "x" + std::to_string(height),
                    "-framerate",
                    rate,
                    "-i",
                    "pipe:0"};
  const std::string file = std::filesystem::path(path).is_absolute() ? path : "./" + path;
  const Words encoder = encoderFor(std::filesystem::path(path).extension().string());
  return plus(plus(plus(input, encoder), sameBytes), {file});
}

}  // namespace

void FilmFile::requireFfmpeg() {
  try {
    ChildProgram({"ffmpeg", "-version"}).finish();
  } catch (const Unavailable&) {
    throw Unavailable("films need the program ffmpeg, which is not installed (Debian: apt install ffmpeg)");
  }
}

FilmFile::FilmFile(const std::string& path, int width, int height, double framesPerSecond)
    : m_ffmpeg(commandFor(path, width, height, framesPerSecond)) {}

void FilmFile::add(const Image& image) {
  if (m_ffmpeg.write(image.rgb)) return;
  m_ffmpeg.finish();
  fail();
}

/// What ffmpeg cannot write at the end, on a full disk, it tells on standard error alone: its status is that of
/// success.
void FilmFile::finish() {
  if (!m_ffmpeg.finish() || !m_ffmpeg.complaint().empty()) fail();
}

void FilmFile::fail() const {
  const std::string complaint = m_ffmpeg.complaint();
  throw std::runtime_error("ffmpeg failed" + (complaint.empty() ? std::string() : ": " + complaint));
}

}  // namespace pictures
