// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/OffscreenContext.h"

#include "command/pictures/Unavailable.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace pictures {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw Unavailable(why + "; pictures need OpenGL 3.3 through EGL (Debian: apt install libegl1 libgl1-mesa-dri)");
}

EGLDisplay initialised(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return EGL_NO_DISPLAY;
  return display;
}

/// Mesa needs no device; others draw on the first device that works.
EGLDisplay openDisplay() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display = initialised(
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, static_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr));
    if (display != EGL_NO_DISPLAY) return display;
  }
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
  for (EGLint i = 0; i < count; ++i) {
    const EGLDisplay display =
        initialised(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
    if (display != EGL_NO_DISPLAY) return display;
  }
  return EGL_NO_DISPLAY;
}

}  // namespace

class OffscreenContext::Display {
 public:
  Display() {
    if (!epoxy_has_egl()) refuse("there is no EGL");
    m_display = openDisplay();
    if (m_display == EGL_NO_DISPLAY) refuse("EGL finds nothing to draw with that needs no display");
    makeContext();
    if (m_context == EGL_NO_CONTEXT || eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context) == 0) {
      release();
      refuse("EGL has no OpenGL 3.3 core without a surface");
    }
  }
  ~Display() { release(); }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  void makeContext() {
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(m_display, wanted, &config, 1, &count) == EGL_FALSE || count == 0) config = EGL_NO_CONFIG_KHR;
    const EGLint version[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    m_context = eglCreateContext(m_display, config, EGL_NO_CONTEXT, version);
  }
  void release() {
    eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (m_context != EGL_NO_CONTEXT) eglDestroyContext(m_display, m_context);
    eglTerminate(m_display);
  }

  EGLDisplay m_display = EGL_NO_DISPLAY;
  EGLContext m_context = EGL_NO_CONTEXT;
};

class OffscreenContext::Framebuffer {
 public:
  Framebuffer(int width, int height) : m_width(width), m_height(height) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (std::max(width, height) > largest) {
      throw std::runtime_error("OpenGL draws at most " + std::to_string(largest) + " pixels here in width and height");
    }
    glGenFramebuffers(1, &m_framebuffer);
    glGenRenderbuffers(1, &m_colour);
    glBindRenderbuffer(GL_RENDERBUFFER, m_colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, m_colour);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
    release();
    throw std::runtime_error("OpenGL cannot make a picture of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");
  }
  ~Framebuffer() { release(); }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// OpenGL's rows begin at the bottom.
  Image read() {
    const std::size_t row = static_cast<std::size_t>(m_width);
    m_pixels.resize(4 * row * static_cast<std::size_t>(m_height));
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
    glReadPixels(0, 0, m_width, m_height, GL_RGBA, GL_UNSIGNED_BYTE, m_pixels.data());
    Image image(m_width, m_height);
    std::uint8_t* to = image.rgb.data();
    for (int y = m_height - 1; y >= 0; --y) {
      const std::uint8_t* from = m_pixels.data() + 4 * row * static_cast<std::size_t>(y);
      for (std::size_t x = 0; x < row; ++x, from += 4, to += 3) std::copy_n(from, 3, to);
    }
    return image;
  }

 private:
  void release() {
    glDeleteFramebuffers(1, &m_framebuffer);
    glDeleteRenderbuffers(1, &m_colour);
  }

  const int m_width;
  const int m_height;
  GLuint m_framebuffer = 0;
  GLuint m_colour = 0;
  std::vector<std::uint8_t> m_pixels;  // with the fourth byte, which drivers copy without a change of format
};

OffscreenContext::OffscreenContext(int width, int height)
    : m_display(std::make_unique<Display>()), m_framebuffer(std::make_unique<Framebuffer>(width, height)) {}

OffscreenContext::~OffscreenContext() {
  m_framebuffer.reset();
  m_display.reset();
}

Image OffscreenContext::read() { return m_framebuffer->read(); }

std::string OffscreenContext::rendererName() const { return reinterpret_cast<const char*>(glGetString(GL_RENDERER)); }

}  // namespace pictures
