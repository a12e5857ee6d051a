// Which part of the window belongs to what: outliner on the left, inspector and render panel on the
// right, the view in the middle. The borders between them can be dragged.
#pragma once

#include "ui/app/rect.h"
#include "ui/panels/widgets.h"

namespace lamplighter {

class Layout {
 public:
  Rect toolbar, left, view, inspector, render, status;
  Rect bottom;  // below outliner and view; empty where nothing is shown there

  // Divides a window of this size; `menuHeight` is taken at the top. All in pixels.
  void divide(vec2 window, float menuHeight, float scale, bool showsBottom);
  // Draws the borders and lets them be dragged. They take effect next frame.
  void splitters(PanelContext ui);

 private:
  void splitter(const PanelContext& ui, const char* name, const Rect& handle, bool vertical,
                float direction, float& value);

  // In design pixels, so that they survive a move to a screen of another scale.
  float leftWidth_ = 232.0f;
  float rightWidth_ = 330.0f;
  float bottomHeight_ = 220.0f;
  float renderShare_ = 0.5f;  // of the right column's height
  float scale_ = 1.0f;
};

}  // namespace lamplighter
