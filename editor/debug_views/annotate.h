// Draws overlays and legends into a picture when there is no viewport to draw them.
#pragma once

#include "editor/tools/overlay.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/image/font.h"

namespace lamplighter {

// `font` is needed only if the overlay contains text.
void drawOverlay(Image8& image, const Overlay& overlay, const Font* font, vec2 origin = vec2(0.0f));

// The picture of a view with its legend in a strip below it, as wide as the picture. Without a
// legend the picture is unchanged.
Image8 withLegend(const ViewPicture& picture, const Font& font);

}  // namespace lamplighter
