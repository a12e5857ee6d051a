// The 3D view: takes the pointer over it to the tools, and shows picture and overlay.
#pragma once

#include <vector>

#include "ui/widgets/input_router.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class Viewport {
 public:
  // Lays the view over `area` of the window and hands the session what the hand does there.
  void takeInput(PanelContext ui, const Rect& area, const PointerKeys& input, float seconds);
  // What panels upon the view hide this frame: labels keep clear of it.
  void setCovered(std::vector<Rect> covered) { covered_ = std::move(covered); }
  // Draws the picture (an OpenGL texture, 0: none), that of a split view's second side, and the
  // session's overlay behind all panels.
  void draw(PanelContext ui, uint32_t texture, uint32_t second) const;

 private:
  Rect area_;
  std::vector<Rect> covered_;
  bool down_[3] = {};  // pressed within the view and still held
};

}  // namespace lamplighter
