// The second side of a split view, the divider, and what the sides are.
#pragma once

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

// texture: of the second side's picture, 0: none yet.
void drawSecondSide(const PanelContext& ui, ImDrawList& list, const Rect& area,
                    const SplitView& split, uint32_t texture);
// Over the picture and its overlay.
void drawSplitLabels(const PanelContext& ui, ImDrawList& list, const Rect& area,
                     const SplitView& split);

}  // namespace lamplighter
