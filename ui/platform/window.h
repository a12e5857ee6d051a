// A GLFW window with an OpenGL 4.5 core context.
#pragma once

#include <array>
#include <optional>

#include "ui/platform/platform.h"

struct GLFWwindow;
struct GLFWcursor;

namespace lamplighter {

class Window final : public Platform {
 public:
  // fixed: the size is in pixels and cannot change, independent of the screen's scale; for
  // recordings.
  enum class Kind { resizable, fixed };
  // `scale`: pixels per design pixel. None: the screen's scale, or 1 for a fixed size. Throws
  // InputError if there is no display or no OpenGL 4.5.
  Window(int width, int height, const std::string& title, Kind kind,
         std::optional<float> scale = {});
  ~Window() override;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  glm::ivec2 size() const override;
  float contentScale() const override;
  glm::ivec2 windowSize() const override;
  void poll(std::vector<InputEvent>& events, double seconds) override;
  bool closeRequested() const override;
  void refuseClose() override;
  void setTitle(const std::string& title) override;
  void setCursor(Cursor cursor) override;
  std::string clipboard() const override;
  void setClipboard(const std::string& text) override;
  bool hasGl() const override { return true; }
  void beginDrawing() override;
  void present() override;
  Image8 screenshot() override;
  double seconds() const override;

 private:
  struct Callbacks;
  GLFWwindow* window_ = nullptr;
  Kind kind_;
  std::optional<float> scale_;
  std::array<GLFWcursor*, 6> cursors_{};
  Cursor cursor_ = Cursor::arrow;
  std::vector<InputEvent> events_;
};

}  // namespace lamplighter
