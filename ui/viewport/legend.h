// What the colours of a view mean, in a corner of the viewport.
#pragma once

#include "renderer/views/view_picture.h"
#include "ui/app/rect.h"
#include "ui/panels/widgets.h"

namespace lamplighter {

// At the lower left of `area`. Where the view could not be made it says why.
void drawLegend(const PanelContext& ui, ImDrawList& list, const Rect& area,
                const ViewPicture& picture);

}  // namespace lamplighter
