// Divides the window: outliner on the left, inspector and render panel on the right, the view in
// the middle. The user can drag the borders between them.
#pragma once

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

// The sizes that the user can change, in design pixels, so that they stay correct on a screen with
// another scale.
struct LayoutSizes {
  float left = 232.0f, right = 330.0f, bottom = 220.0f;
  float renderShare = 0.5f;  // fraction of the right column's height
  bool operator==(const LayoutSizes&) const = default;
};

class Layout {
 public:
  Rect toolbar, left, view, inspector, render, status;
  Rect bottom;  // below outliner and view; empty if no panel is shown there

  // Divides a window of this size. `menuHeight` is the height of the menu bar at the top. All in
  // pixels.
  void divide(vec2 window, float menuHeight, float scale, bool showsBottom);
  // Draws the borders and handles their drags. Changes take effect in the next frame.
  void splitters(PanelContext ui);
  const LayoutSizes& sizes() const { return sizes_; }
  void setSizes(const LayoutSizes& sizes) { sizes_ = sizes; }

 private:
  void splitter(const PanelContext& ui, const char* name, const Rect& handle, bool vertical,
                float direction, float LayoutSizes::*size);

  // The wanted sizes, and the sizes that fit the window. A temporarily small window does not change
  // the wanted sizes.
  LayoutSizes sizes_, shown_;
  float scale_ = 1.0f;
};

}  // namespace lamplighter
