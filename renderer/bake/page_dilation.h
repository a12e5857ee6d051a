// Fills the unknown texels of a light map, so that filters read plausible light there.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// Gives each negative (unknown) texel the mean of its known neighbours, ring by ring. Texels far
// from all known ones become 0.
void fillUnknown(Image& page);

}  // namespace lamplighter
