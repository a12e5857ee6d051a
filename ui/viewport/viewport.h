// The 3D view: passes pointer input to the tools, and shows the picture and the overlay.
#pragma once

#include <vector>

#include "ui/widgets/input_router.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

class Viewport {
 public:
  // Places the view at `area` of the window and passes the input over it to the session.
  void takeInput(PanelContext ui, const Rect& area, const PointerKeys& input, float seconds);
  // The parts of the view that panels cover in this frame. Labels avoid them.
  void setCovered(std::vector<Rect> covered) { covered_ = std::move(covered); }
  // Draws the picture (an OpenGL texture, 0: none), the second picture of a split view, and the
  // session's overlay, behind all panels.
  void draw(PanelContext ui, uint32_t texture, uint32_t second) const;

 private:
  Rect area_;
  std::vector<Rect> covered_;
  bool down_[3] = {};  // pressed within the view and still held
};

}  // namespace lamplighter
