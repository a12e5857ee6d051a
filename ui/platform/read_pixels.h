// Reads the framebuffer that is bound for reading.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// Opaque, top row first.
Image8 readPixels(glm::ivec2 size);

}  // namespace lamplighter
