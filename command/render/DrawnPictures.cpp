// SPDX-License-Identifier: Zlib
#include "command/render/DrawnPictures.h"

#include "command/pictures/Unavailable.h"

#ifndef WETCLOTH_HAS_RENDERER

namespace command {
namespace {

[[noreturn]] void refuse() {
  throw pictures::Unavailable(
      "this wetcloth was built without its renderer (Debian: apt install libepoxy-dev "
      "libstb-dev, and build it again)");
}

}  // namespace

void requirePng(int, int) { refuse(); }
void requireFilm(int, int) { refuse(); }
RenderResult drawPng(const RenderJob&) { refuse(); }
RenderResult drawFilm(const RenderJob&) { refuse(); }

}  // namespace command

#else

#include "command/cli/Progress.h"

#include "command/pictures/FilmFile.h"
#include "command/pictures/PngFile.h"
#include "command/pictures/Strip.h"
#include "command/pictures/View.h"
#include "command/pictures/gl/OffscreenContext.h"
#include "command/pictures/gl/Renderer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <utility>

namespace command {
namespace {

using pictures::Frame;
using pictures::Image;
using pictures::Renderer;

/// Enough frames of all panels for a camera that sees them all.
std::vector<Frame> sampleOf(const std::vector<Panel>& panels) {
  constexpr std::size_t most = 60;
  std::vector<Frame> sample;
  for (const Panel& panel : panels) {
    const std::vector<Frame>& frames = panel.sequence.frames;
    const std::size_t stride = 1 + frames.size() / most;
    for (std::size_t i = 0; i < frames.size(); i += stride) sample.push_back(frames[i]);
    sample.push_back(frames.back());
  }
  return sample;
}

double meanSaturation(const Frame& frame) {
  double sum = 0;
  std::size_t count = 0;
  for (const pictures::ClothState& cloth : frame.cloths) {
    sum = std::accumulate(cloth.saturation.begin(), cloth.saturation.end(), sum);
    count += cloth.saturation.size();
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

std::string stateText(const Frame& frame) {
  char text[96];
  std::snprintf(text, sizeof text, "t = %.2f s, saturation %.0f %%", frame.time, 100 * meanSaturation(frame));
  return text;
}

/// A white line down a picture, two pixels wide.
void rule(Image& image, int left) {
  for (int y = 0; y < image.height; ++y) {
    const std::ptrdiff_t from = 3 * (static_cast<std::ptrdiff_t>(y) * image.width + left - 1);
    std::fill_n(image.rgb.begin() + from, 6, std::uint8_t{255});
  }
}

/// Draws the frames of a job.
class Drawing {
 public:
  explicit Drawing(const RenderJob& job) : m_job(job), m_context(job.width, job.height) {
    const int panels = static_cast<int>(job.panels.size());
    for (int i = 0; i < panels; ++i) {
      const int left = i * job.width / panels;
      m_areas.push_back({left, 0, (i + 1) * job.width / panels - left, job.height});
    }
    const Renderer::Area& area = m_areas.front();
    m_view = pictures::fitView(job.panels.front().sequence.scenery, sampleOf(job.panels),
                               static_cast<float>(area.width) / static_cast<float>(area.height));
    for (const Panel& panel : job.panels) {
      m_renderers.push_back(std::make_unique<Renderer>(panel.sequence.scenery, panel.sequence.cloths));
      m_renderers.back()->setColouring(job.colouring);
    }
    // The colours mean the same in all frames of all panels.
    for (const auto& renderer : m_renderers) {
      for (const Panel& panel : job.panels) {
        for (const Frame& frame : panel.sequence.frames) renderer->includeInColourBar(frame);
      }
    }
  }

  std::size_t frameCount() const { return m_job.panels.front().sequence.frames.size(); }

  Image draw(std::size_t index) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < m_renderers.size(); ++i) {
      m_renderers[i]->draw(m_job.panels[i].sequence.frames[index], m_view, m_areas[i]);
      m_renderers[i]->writeHead(m_job.panels[i].heading, m_areas[i]);
    }
    const pictures::FrameSequence& last = m_job.panels.back().sequence;  // the wet one
    m_renderers.back()->write(last.scenery.title, stateText(last.frames[index]), {0, 0, m_job.width, m_job.height});
    Image image = m_context.read();
    for (std::size_t i = 1; i < m_areas.size(); ++i) rule(image, m_areas[i].x);
    m_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return image;
  }

  RenderResult result(int width, int height) const { return {width, height, m_seconds, m_context.rendererName()}; }

 private:
  const RenderJob& m_job;
  pictures::OffscreenContext m_context;
  std::vector<Renderer::Area> m_areas;
  pictures::View m_view;
  std::vector<std::unique_ptr<Renderer>> m_renderers;
  double m_seconds = 0;
};

}  // namespace

void requirePng(int width, int height) { const pictures::OffscreenContext tried(width, height); }

void requireFilm(int width, int height) {
  pictures::FilmFile::requireFfmpeg();
  requirePng(width, height);
}

RenderResult drawPng(const RenderJob& job) {
  Drawing drawing(job);
  Progress progress("drawing");
  std::vector<Image> images;
  while (images.size() < drawing.frameCount()) {
    images.push_back(drawing.draw(images.size()));
    progress.update(static_cast<double>(images.size()) / static_cast<double>(drawing.frameCount()));
  }
  const Image whole = images.size() == 1 ? std::move(images.front()) : pictures::strip(images);
  pictures::writePng(job.path, whole);
  return drawing.result(whole.width, whole.height);
}

RenderResult drawFilm(const RenderJob& job) {
  Drawing drawing(job);
  pictures::FilmFile film(job.path, job.width, job.height, job.framesPerSecond);
  Progress progress("drawing");
  for (std::size_t i = 0; i < drawing.frameCount(); ++i) {
    film.add(drawing.draw(i));
    progress.update(static_cast<double>(i + 1) / static_cast<double>(drawing.frameCount()));
  }
  film.finish();
  return drawing.result(job.width, job.height);
}

}  // namespace command

#endif
