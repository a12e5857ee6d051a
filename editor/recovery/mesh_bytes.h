// Primitives of a mesh as bytes and back, as the machine has them: for the journal on this machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

std::vector<uint8_t> bytesOf(const std::vector<Primitive>& primitives);
// Throws InputError for what are none.
std::vector<Primitive> primitivesOf(std::span<const uint8_t> bytes);

}  // namespace lamplighter
