// What is in the framebuffer that is bound for reading.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// Opaque, row 0 the top.
Image8 readPixels(glm::ivec2 size);

}  // namespace lamplighter
