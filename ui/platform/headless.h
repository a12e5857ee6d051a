// No window: the user interface is laid out as ever. With OpenGL (a surfaceless EGL context) it is
// drawn too, so that pictures of it can be taken; without, nothing is needed at all.
#pragma once

#include "ui/platform/platform.h"

namespace lamplighter {

class Headless final : public Platform {
 public:
  // `drawing`: an OpenGL context is current and stays so. `scale`: pixels a design pixel.
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
