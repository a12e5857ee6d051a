#include "ui/platform/window.h"

#include <algorithm>

#include <epoxy/gl.h>
// GLFW must not include its own GL header.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <spdlog/spdlog.h>

#include "editor/actions/arguments.h"
#include "renderer/base/error.h"
#include "ui/platform/glfw_keys.h"
#include "ui/platform/read_pixels.h"
#include "ui/platform/ui_scale.h"

namespace lamplighter {
namespace {

// Converts a code point to UTF-8.
std::string utf8(unsigned codepoint) {
  std::string out;
  const auto put = [&](unsigned byte) { out.push_back(static_cast<char>(byte)); };
  if (codepoint < 0x80) {
    put(codepoint);
  } else if (codepoint < 0x800) {
    put(0xc0 | codepoint >> 6);
    put(0x80 | (codepoint & 0x3f));
  } else if (codepoint < 0x10000) {
    put(0xe0 | codepoint >> 12);
    put(0x80 | (codepoint >> 6 & 0x3f));
    put(0x80 | (codepoint & 0x3f));
  } else {
    put(0xf0 | codepoint >> 18);
    put(0x80 | (codepoint >> 12 & 0x3f));
    put(0x80 | (codepoint >> 6 & 0x3f));
    put(0x80 | (codepoint & 0x3f));
  }
  return out;
}

#ifdef LAMPLIGHTER_DEBUG
void GLAPIENTRY onGlMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei,
                            const GLchar* message, const void*) {
  if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
  if (type == GL_DEBUG_TYPE_ERROR)
    spdlog::error("OpenGL: {}", message);
  else
    spdlog::debug("OpenGL: {}", message);
}
#endif

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "unknown reason";
}

}  // namespace

struct Window::Callbacks {
  static Window& self(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static void cursor(GLFWwindow* window, double x, double y) {
    // GLFW uses screen coordinates; the program uses framebuffer pixels.
    int w = 1, h = 1, fw = 1, fh = 1;
    glfwGetWindowSize(window, &w, &h);
    glfwGetFramebufferSize(window, &fw, &fh);
    InputEvent e;
    e.kind = EventKind::pointer;
    e.position = {static_cast<float>(x * fw / std::max(w, 1)),
                  static_cast<float>(y * fh / std::max(h, 1))};
    self(window).events_.push_back(e);
  }
  static void button(GLFWwindow* window, int button, int action, int) {
    if (button > 2) return;
    InputEvent e;
    e.kind = EventKind::button;
    e.button = button;
    e.down = action == GLFW_PRESS;
    self(window).events_.push_back(e);
  }
  static void wheel(GLFWwindow* window, double x, double y) {
    InputEvent e;
    e.kind = EventKind::wheel;
    e.wheel = {static_cast<float>(x), static_cast<float>(y)};
    self(window).events_.push_back(e);
  }
  static void key(GLFWwindow* window, int key, int, int action, int) {
    InputEvent e;
    e.kind = EventKind::key;
    e.key = keyOfGlfw(key);
    if (e.key == Key::none || action == GLFW_REPEAT) return;  // ImGui creates its own key repeats
    e.down = action == GLFW_PRESS;
    self(window).events_.push_back(e);
  }
  static void text(GLFWwindow* window, unsigned codepoint) {
    InputEvent e;
    e.kind = EventKind::text;
    e.text = utf8(codepoint);
    self(window).events_.push_back(e);
  }
  // Queues the action for dropped files, after the pointer position of the drop.
  static void drop(GLFWwindow* window, int count, const char** paths) {
    InputEvent e;
    e.kind = EventKind::action;
    e.text = "file.drop";
    for (int i = 0; i < count; ++i) e.text += " " + quoted(paths[i]);
    self(window).events_.push_back(e);
  }
};

Window::Window(int width, int height, const std::string& title, Kind kind,
               std::optional<float> scale)
    : kind_(kind), scale_(scale) {
  if (!glfwInit())
    throw InputError("no display: " + glfwReason() + "; set DISPLAY or use 'lamplighter render'");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // Tells of resets of the device; ignored where the driver cannot.
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, kind == Kind::resizable ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_RESIZABLE, kind == Kind::resizable ? GLFW_TRUE : GLFW_FALSE);
#ifdef LAMPLIGHTER_DEBUG
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
#endif
  // A saved size from a larger screen, or one edited by hand, must not prevent opening the window.
  if (GLFWmonitor* monitor = kind == Kind::resizable ? glfwGetPrimaryMonitor() : nullptr) {
    int x = 0, y = 0, w = 0, h = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
    if (w > 0 && h > 0) {
      width = std::min(width, w);
      height = std::min(height, h);
    }
  }
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = glfwReason();
    glfwTerminate();
    throw InputError("no window with OpenGL 4.5: " + reason +
                     "; update the graphics driver or use 'lamplighter render --backend cpu'");
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
#ifdef LAMPLIGHTER_DEBUG
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onGlMessage, nullptr);
#endif
  glfwSetWindowUserPointer(window_, this);
  glfwSetCursorPosCallback(window_, Callbacks::cursor);
  glfwSetMouseButtonCallback(window_, Callbacks::button);
  glfwSetScrollCallback(window_, Callbacks::wheel);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetCharCallback(window_, Callbacks::text);
  glfwSetDropCallback(window_, Callbacks::drop);
  if (kind == Kind::resizable)
    glfwSetWindowSizeLimits(window_, 640, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
}

Window::~Window() {
  for (GLFWcursor* cursor : cursors_)
    if (cursor) glfwDestroyCursor(cursor);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

glm::ivec2 Window::size() const {
  glm::ivec2 size(0);
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

float Window::contentScale() const {
  if (scale_) return *scale_;
  if (kind_ == Kind::fixed) return 1.0f;
  float x = 1.0f;
  glfwGetWindowContentScale(window_, &x, nullptr);
  return std::clamp(x, kLeastUiScale, kMostUiScale);
}

glm::ivec2 Window::windowSize() const {
  glm::ivec2 size(0);
  glfwGetWindowSize(window_, &size.x, &size.y);
  float x = 1.0f, y = 1.0f;
  if (kind_ == Kind::resizable) glfwGetWindowContentScale(window_, &x, &y);
  return glm::ivec2(glm::round(vec2(size) / glm::max(vec2(x, y), vec2(0.1f))));
}

void Window::poll(std::vector<InputEvent>& events, double seconds) {
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  events.insert(events.end(), events_.begin(), events_.end());
  events_.clear();
}

bool Window::closeRequested() const { return glfwWindowShouldClose(window_); }

void Window::refuseClose() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::setCursor(Cursor cursor) {
  if (cursor == cursor_) return;
  cursor_ = cursor;
  constexpr std::array shapes = {GLFW_ARROW_CURSOR,   GLFW_IBEAM_CURSOR, GLFW_HRESIZE_CURSOR,
                                 GLFW_VRESIZE_CURSOR, GLFW_HAND_CURSOR,  GLFW_ARROW_CURSOR};
  const auto i = static_cast<size_t>(cursor);
  if (!cursors_[i]) cursors_[i] = glfwCreateStandardCursor(shapes[i]);
  glfwSetCursor(window_, cursors_[i]);
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_);
  return text ? text : "";
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

void Window::beginDrawing() {
  const glm::ivec2 extent = size();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, extent.x, extent.y);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.09f, 0.094f, 0.106f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Window::present() { glfwSwapBuffers(window_); }

Image8 Window::screenshot() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  return readPixels(size());
}

double Window::seconds() const { return glfwGetTime(); }

}  // namespace lamplighter
