// Dear ImGui's context: its set-up, what it is fed each frame, and how its draw lists reach OpenGL.
// Nothing but this class writes to ImGuiIO, so a recording sees all that ImGui sees.
#pragma once

#include "ui/platform/platform.h"
#include "ui/widgets/input_router.h"

struct ImGuiContext;

namespace lamplighter {

class ImGuiLayer {
 public:
  explicit ImGuiLayer(Platform& platform);
  ~ImGuiLayer();
  ImGuiLayer(const ImGuiLayer&) = delete;
  ImGuiLayer& operator=(const ImGuiLayer&) = delete;

  // `scale`: pixels a design pixel.
  void beginFrame(const PointerKeys& input, float seconds, float scale);
  // Lays out what was drawn and, where there is OpenGL, draws it into the platform's framebuffer.
  void endFrame(bool draws = true);

 private:
  void rescale(float scale);

  Platform& platform_;
  ImGuiContext* context_;
  float scale_ = 0.0f;
  std::string clipboard_;
};

}  // namespace lamplighter
