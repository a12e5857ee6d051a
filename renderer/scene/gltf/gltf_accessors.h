// Reads typed data from buffers: accessors of all component types, normalised, strided and sparse.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

enum class ComponentType : uint16_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126,
};

// Bytes per component; 0 if the number is not a component type.
size_t componentSize(size_t componentType);

// Shape of an accessor's elements.
struct ElementLayout {
  size_t components = 0;  // 1, 2, 3, 4, 9 or 16; 0 if the type is unknown
  size_t bytes = 0;       // of one element, including the padding of matrix columns
};
ElementLayout elementLayout(const std::string& type, size_t componentType);

// The bytes of the elements; checkStructure() has verified that they exist.
struct AccessorView {
  size_t count = 0;
  ComponentType component = ComponentType::float32;
  ElementLayout layout;
  bool normalized = false;
  const uint8_t* data = nullptr;  // null: zeros
  size_t stride = 0;
};
AccessorView accessorView(const GltfDocument& document, size_t accessor);

// All elements as floats, `components` per element. Missing components are 0, a missing fourth is
// 1. Normalised integers are scaled to [0, 1] or [-1, 1] (glTF 2.0, section 3.11).
std::vector<float> readFloats(const GltfDocument& document, size_t accessor, size_t components);
std::vector<vec2> readVec2(const GltfDocument& document, size_t accessor);
std::vector<vec3> readVec3(const GltfDocument& document, size_t accessor);
std::vector<vec4> readVec4(const GltfDocument& document, size_t accessor);
std::vector<uint32_t> readIndices(const GltfDocument& document, size_t accessor);

}  // namespace lamplighter
