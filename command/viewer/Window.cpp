// SPDX-License-Identifier: Zlib
#include "command/viewer/Window.h"

#include "command/cli/Errors.h"
#include "command/pictures/Font.h"

#include <epoxy/gl.h>
// after epoxy, which replaces the system's OpenGL header
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace viewer {
namespace {

[[noreturn]] void failToOpen() {
  const char* description = nullptr;
  glfwGetError(&description);
  throw command::RunError("wetcloth: no window could be opened: " +
                          command::onOneLine(description != nullptr ? description : "the display gives no reason") +
                          "; `wetcloth render` needs no display");
}

/// "" for a key without a name.
std::string nameOf(int key, int scancode) {
  if (key == GLFW_KEY_ESCAPE) return "escape";
  if (key == GLFW_KEY_SPACE) return "space";
  // By their place: on some keyboards digits need the shift key.
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) return std::string(1, static_cast<char>('1' + key - GLFW_KEY_1));
  const char* const name = glfwGetKeyName(key, scancode);
  return name != nullptr ? name : "";
}

constexpr float textHeight = 15;  // in the window's units, at usual size

void chooseFont(float scale) {
  const std::string_view font = pictures::fontFile();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  // ImGui wants to be able to change it, and does not.
  ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(font.data()), static_cast<int>(font.size()),
                                             textHeight * scale, &config);
}

void style(float scale) {
  chooseFont(scale);
  ImGui::StyleColorsDark();
  ImGuiStyle& look = ImGui::GetStyle();
  look.WindowRounding = 0;
  look.FrameRounding = 3;
  look.GrabRounding = 3;
  look.WindowBorderSize = 0;
  look.ScrollbarSize = 10;
  look.ItemSpacing = ImVec2(8, 4);
  look.FramePadding = ImVec2(5, 2);
  look.WindowPadding = ImVec2(10, 8);
  look.Colors[ImGuiCol_WindowBg] = ImVec4(0.11F, 0.12F, 0.14F, 1);
  look.Colors[ImGuiCol_PlotLines] = ImVec4(0.45F, 0.75F, 1.0F, 1);
  look.ScaleAllSizes(scale);
}

}  // namespace

class Window::Parts {
 public:
  /// GLFW itself, from the first use of it to the last.
  class Library {
   public:
    Library() {
      if (glfwInit() == GLFW_FALSE) failToOpen();
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
  };

  Parts(const std::string& title, int width, int height) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr) failToOpen();
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* own, int key, int scancode, int action, int) {
      static_cast<Parts*>(glfwGetWindowUserPointer(own))->note(key, scancode, action);
    });
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no file of settings in the user's folder
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~Parts() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void note(int key, int scancode, int action) {
    const std::string name = nameOf(key, scancode);
    const bool repeats = name == "n" || name == ".";
    if (name.empty() || action == GLFW_RELEASE || (action == GLFW_REPEAT && !repeats)) return;
    if (!ImGui::GetIO().WantTextInput) keys.push_back(name);
  }

  Library library;
  GLFWwindow* window = nullptr;
  std::vector<std::string> keys;
  std::vector<std::string> keysOfPicture;
};

Window::Window(const std::string& title, int width, int height)
    : m_parts(std::make_unique<Parts>(title, width, height)) {
  style(static_cast<float>(textScale()));
}

Window::~Window() = default;

bool Window::isClosed() const { return glfwWindowShouldClose(m_parts->window) != GLFW_FALSE; }
void Window::close() { glfwSetWindowShouldClose(m_parts->window, GLFW_TRUE); }

int Window::width() const {
  int width = 0;
  glfwGetFramebufferSize(m_parts->window, &width, nullptr);
  return width;
}

int Window::height() const {
  int height = 0;
  glfwGetFramebufferSize(m_parts->window, nullptr, &height);
  return height;
}

double Window::pixelsPerUnit() const {
  int width = 0;
  glfwGetWindowSize(m_parts->window, &width, nullptr);
  return width > 0 ? static_cast<double>(this->width()) / width : 1;
}

/// Where a window's units are pixels, on displays of many pixels everything would be small.
double Window::textScale() const {
  float scale = 1;
  glfwGetWindowContentScale(m_parts->window, &scale, nullptr);
  return std::clamp(static_cast<double>(scale) / pixelsPerUnit(), 1.0, 4.0);
}

double Window::time() const { return glfwGetTime(); }

void Window::beginPicture(double patience) {
  if (patience > 0) {
    glfwWaitEventsTimeout(patience);
  } else {
    glfwPollEvents();
  }
  m_parts->keysOfPicture.clear();
  m_parts->keysOfPicture.swap(m_parts->keys);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

const std::vector<std::string>& Window::keys() const { return m_parts->keysOfPicture; }

void Window::drawWidgets() {
  glViewport(0, 0, width(), height());
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

pictures::Image Window::read() const {
  pictures::Image image(width(), height());
  const std::size_t row = static_cast<std::size_t>(image.width) * 3;
  std::vector<std::uint8_t> fromBelow(image.rgb.size());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, fromBelow.data());
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    const auto from = fromBelow.end() - static_cast<std::ptrdiff_t>((y + 1) * row);
    std::copy(from, from + static_cast<std::ptrdiff_t>(row), image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return image;
}

void Window::show() { glfwSwapBuffers(m_parts->window); }

}  // namespace viewer
