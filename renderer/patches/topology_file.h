// The topology of a mesh as bytes, for files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/patches/topology.h"

namespace lamplighter {

std::vector<uint8_t> bytesOf(const MeshTopology& topology);
// The topology of an object with the bits that findTopology() gives, or none if the bytes are not
// those of a topology of its mesh.
std::optional<MeshTopology> topologyOf(std::span<const uint8_t> bytes, const RenderScene& scene,
                                       uint32_t object);

}  // namespace lamplighter
