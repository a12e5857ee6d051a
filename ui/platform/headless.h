// A platform without a window. The layout of the user interface is done as in a window. With OpenGL
// (a surfaceless EGL context) it is also drawn, for screenshots. Without OpenGL it has no
// requirements.
#pragma once

#include "ui/platform/platform.h"

namespace lamplighter {

class Headless final : public Platform {
 public:
  // `drawing`: an OpenGL context is current and stays current. `scale`: pixels per design pixel.
  Headless(int width, int height, bool drawing, float scale = 1.0f);
  ~Headless() override;
  Headless(const Headless&) = delete;
  Headless& operator=(const Headless&) = delete;

  glm::ivec2 size() const override { return size_; }
  float contentScale() const override { return scale_; }
  glm::ivec2 windowSize() const override { return size_; }
  void poll(std::vector<InputEvent>&, double) override {}
  bool closeRequested() const override { return false; }
  void refuseClose() override {}
  void setTitle(const std::string&) override {}
  void setCursor(Cursor) override {}
  std::string clipboard() const override { return clipboard_; }
  void setClipboard(const std::string& text) override { clipboard_ = text; }
  bool hasGl() const override { return framebuffer_ != 0; }
  void beginDrawing() override;
  void present() override {}
  Image8 screenshot() override;
  double seconds() const override;

 private:
  glm::ivec2 size_;
  float scale_;
  std::string clipboard_;
  uint32_t framebuffer_ = 0, colour_ = 0;
};

}  // namespace lamplighter
