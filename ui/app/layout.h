// Which part of the window belongs to what: outliner on the left, inspector and render panel on the
// right, the view in the middle. The borders between them can be dragged.
#pragma once

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

// What can be dragged, in design pixels, so that it survives a move to a screen of another scale.
struct LayoutSizes {
  float left = 232.0f, right = 330.0f, bottom = 220.0f;
  float renderShare = 0.5f;  // of the right column's height
  bool operator==(const LayoutSizes&) const = default;
};

class Layout {
 public:
  Rect toolbar, left, view, inspector, render, status;
  Rect bottom;  // below outliner and view; empty where nothing is shown there

  // Divides a window of this size; `menuHeight` is taken at the top. All in pixels.
  void divide(vec2 window, float menuHeight, float scale, bool showsBottom);
  // Draws the borders and lets them be dragged. They take effect next frame.
  void splitters(PanelContext ui);
  const LayoutSizes& sizes() const { return sizes_; }
  void setSizes(const LayoutSizes& sizes) { sizes_ = sizes; }

 private:
  void splitter(const PanelContext& ui, const char* name, const Rect& handle, bool vertical,
                float direction, float LayoutSizes::*size);

  // As asked for, and as the window has room: one that was small for a while forgets nothing.
  LayoutSizes sizes_, shown_;
  float scale_ = 1.0f;
};

}  // namespace lamplighter
