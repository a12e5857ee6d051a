// Fills the texels of a light map of which nothing is known, so that filters find light there.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// Negative texels take the mean of their neighbours that are known, ring by ring; far from all
// they become 0.
void fillUnknown(Image& page);

}  // namespace lamplighter
