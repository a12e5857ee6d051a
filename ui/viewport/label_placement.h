// Places labels of the overlay so that they are readable.
#pragma once

#include <vector>

#include "ui/widgets/rect.h"

namespace lamplighter {

// Moves `label` by the shortest distance so that it is within `area` and does not overlap
// `covered`. If there is no such place, it is only moved into the area.
Rect clearPlace(const Rect& label, const Rect& area, const std::vector<Rect>& covered);

}  // namespace lamplighter
