// Draws the second side of a split view, the divider, and the labels of the sides and tiles.
#pragma once

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

// texture: the picture of the second side; 0: none yet.
void drawSecondSide(const PanelContext& ui, ImDrawList& list, const Rect& area,
                    const SplitView& split, uint32_t texture);
// Drawn over the picture and its overlay.
void drawSplitLabels(const PanelContext& ui, ImDrawList& list, const Rect& area,
                     const SplitView& split);

// The lines of text under a tile, cut off at the edge of `area`.
void drawTileCaption(ImDrawList& list, const Rect& area, const SplitView& split, size_t side);

}  // namespace lamplighter
