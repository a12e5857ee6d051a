// A coherent order of the texels of an object, so that the depth maps of consecutive texels are
// similar (paper 3, section 3.2.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/texels/texel_set.h"

namespace lamplighter {

// A permutation of the texels of one object.
std::vector<uint32_t> orderOf(std::span<const SurfaceTexel> texels, TexelOrder order);

}  // namespace lamplighter
