// Where a label of the overlay goes so that it can be read.
#pragma once

#include <vector>

#include "ui/widgets/rect.h"

namespace lamplighter {

// `label` moved as little as need be to lie within `area` and beside everything in `covered`; left
// within the area where there is no such place.
Rect clearPlace(const Rect& label, const Rect& area, const std::vector<Rect>& covered);

}  // namespace lamplighter
