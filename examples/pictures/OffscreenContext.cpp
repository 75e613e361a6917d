#include "OffscreenContext.h"

#include "Unavailable.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstddef>
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

/// Drawn into with several samples for each pixel, and read from another with one.
class OffscreenContext::Framebuffer {
 public:
  Framebuffer(int width, int height) : m_width(width), m_height(height) {
    GLint largest = 0;
    GLint samples = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    glGetIntegerv(GL_MAX_SAMPLES, &samples);
    if (std::max(width, height) > largest) {
      throw std::runtime_error("OpenGL draws at most " + std::to_string(largest) + " pixels here in width and height");
    }
    samples = std::min(samples, 4);
    glGenFramebuffers(2, m_framebuffers.data());
    glGenRenderbuffers(3, m_renderbuffers.data());
    attach(resolved, 2, GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
    attach(drawn, 0, GL_COLOR_ATTACHMENT0, GL_RGBA8, samples);
    attach(drawn, 1, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw std::runtime_error("OpenGL cannot make a picture of " + std::to_string(width) + " x " +
                               std::to_string(height) + " pixels");
    }
  }
  ~Framebuffer() {
    glDeleteFramebuffers(2, m_framebuffers.data());
    glDeleteRenderbuffers(3, m_renderbuffers.data());
  }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  Image read() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_framebuffers[drawn]);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffers[resolved]);
    glBlitFramebuffer(0, 0, m_width, m_height, 0, 0, m_width, m_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_framebuffers[resolved]);
    Image upsideDown(m_width, m_height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, m_width, m_height, GL_RGB, GL_UNSIGNED_BYTE, upsideDown.rgb.data());
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffers[drawn]);
    const std::size_t row = 3 * static_cast<std::size_t>(m_width);
    Image image(m_width, m_height);
    for (std::size_t i = 0; i < static_cast<std::size_t>(m_height); ++i) {
      const std::size_t from = (static_cast<std::size_t>(m_height) - 1 - i) * row;
      std::copy_n(upsideDown.rgb.data() + from, row, image.rgb.data() + i * row);
    }
    return image;
  }

 private:
  static constexpr std::size_t drawn = 0;
  static constexpr std::size_t resolved = 1;

  void attach(std::size_t framebuffer, std::size_t renderbuffer, GLenum attachment, GLenum format, int samples) {
    glBindRenderbuffer(GL_RENDERBUFFER, m_renderbuffers[renderbuffer]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, m_width, m_height);
    glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffers[framebuffer]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, m_renderbuffers[renderbuffer]);
  }

  const int m_width;
  const int m_height;
  std::array<GLuint, 2> m_framebuffers{};
  std::array<GLuint, 3> m_renderbuffers{};
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
