// Overlays and legends within a picture, where there is no viewport to draw them over it.
#pragma once

#include "editor/tools/overlay.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/image/font.h"

namespace lamplighter {

// font: where the overlay holds text.
void drawOverlay(Image8& image, const Overlay& overlay, const Font* font, vec2 origin = vec2(0.0f));

// The picture of a view with its legend in a strip below, as wide as the picture; as it is where
// the view has none.
Image8 withLegend(const ViewPicture& picture, const Font& font);

}  // namespace lamplighter
