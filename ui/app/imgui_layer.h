// Dear ImGui's context: set-up, input of each frame, and drawing its draw lists with OpenGL. Only
// this class writes to ImGuiIO, so a recording contains everything that ImGui sees.
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

  // `scale`: pixels per design pixel.
  void beginFrame(const PointerKeys& input, float seconds, float scale);
  // Ends the ImGui frame. With OpenGL, draws it into the platform's framebuffer.
  void endFrame(bool draws = true);

 private:
  void rescale(float scale);

  Platform& platform_;
  ImGuiContext* context_;
  float scale_ = 0.0f;
  std::string clipboard_;
};

}  // namespace lamplighter
