// Reads typed data from buffers: accessors of all component types, normalised, strided and sparse.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

// Shape of an accessor's elements.
struct ElementLayout {
  size_t components = 0;  // 1, 2, 3, 4, 9, 16; 0 for an unknown type
  size_t bytes = 0;       // of one element, the padding of matrix columns included
};
ElementLayout elementLayout(std::string_view type, size_t componentType);

// Number of elements of an accessor.
size_t elementCount(const GltfDocument& document, size_t accessor);

// All elements as floats (components that the accessor lacks are 0, 4th ones 1);
// normalised integers are scaled to [0, 1] or [-1, 1] as glTF 2.0 section 3.11 says.
std::vector<vec2> readVec2(const GltfDocument& document, size_t accessor);
std::vector<vec3> readVec3(const GltfDocument& document, size_t accessor);
std::vector<vec4> readVec4(const GltfDocument& document, size_t accessor);
std::vector<uint32_t> readIndices(const GltfDocument& document, size_t accessor);

}  // namespace lamplighter
