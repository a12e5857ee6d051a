// Converts primitives of a mesh to bytes and back, in the machine's own format: for journals on the
// same machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

std::vector<uint8_t> bytesOf(const std::vector<Primitive>& primitives);
// Throws InputError for invalid bytes.
std::vector<Primitive> primitivesOf(std::span<const uint8_t> bytes);

}  // namespace lamplighter
