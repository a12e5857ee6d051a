// The 3D view: passes pointer input to the tools, and shows the picture and the overlay.
#pragma once

#include <span>
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
  // Draws the picture, those of the other sides of a split view, and the session's overlay, behind
  // all panels. textures: of OpenGL, the first side's first; 0: no picture.
  void draw(PanelContext ui, std::span<const uint32_t> textures) const;

 private:
  void drawTiles(const PanelContext& ui, ImDrawList& list,
                 std::span<const uint32_t> textures) const;

  Rect area_;
  std::vector<Rect> covered_;
  bool down_[3] = {};  // pressed within the view and still held
};

}  // namespace lamplighter
