#include "renderer/scene/gltf/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include <tiny_gltf.h>

namespace lamplighter {

namespace {

// `type` as tinygltf has it.
ElementLayout layoutOf(int type, int componentType) {
  const auto components = static_cast<size_t>(tinygltf::GetNumComponentsInType(uint32_t(type)));
  const auto size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(uint32_t(componentType)));
  const bool isMatrix =
      type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3 || type == TINYGLTF_TYPE_MAT4;
  if (!isMatrix) return {components, components * size};
  // Columns of matrices begin at multiples of four bytes (glTF 2.0, 3.6.2.4).
  const size_t columns = static_cast<size_t>(type) - 32;
  return {components, columns * ((columns * size + 3) / 4 * 4)};
}

// Elements as they lie in a buffer, checked by checkStructure() to be there.
struct AccessorView {
  const uint8_t* data = nullptr;  // null: zeros
  size_t stride = 0;
};

AccessorView viewOf(const GltfDocument& document, int bufferView, size_t offset,
                    size_t elementBytes) {
  if (bufferView < 0) return {};
  const tinygltf::BufferView& view = document.model->bufferViews[static_cast<size_t>(bufferView)];
  return {document.buffers[static_cast<size_t>(view.buffer)]->data() + view.byteOffset + offset,
          view.byteStride == 0 ? elementBytes : view.byteStride};
}

// What a component is as a float.
template <typename T>
float toFloat(T value, bool normalized) {
  if constexpr (std::is_same_v<T, float>) {
    return value;
  } else {
    const float f = static_cast<float>(value);
    if (!normalized) return f;
    return std::max(f / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }
}

// The first `n` components of `count` elements to `out`, where they are `components` apart.
template <typename T>
void convert(const AccessorView& view, size_t n, size_t count, bool normalized, size_t components,
             float* out) {
  const size_t bytes = n * sizeof(float);
  if (std::is_same_v<T, float> && n == components && view.stride == bytes) {
    std::memcpy(out, view.data, count * bytes);
    return;
  }
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < n; ++c) {
      T value;
      std::memcpy(&value, view.data + i * view.stride + c * sizeof(T), sizeof(T));
      out[i * components + c] = toFloat(value, normalized);
    }
  }
}

void convertAny(const tinygltf::Accessor& accessor, const AccessorView& view, size_t n,
                size_t count, size_t components, float* out) {
  const auto as = [&]<typename T>(T) {
    convert<T>(view, n, count, accessor.normalized, components, out);
  };
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return as(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return as(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as(uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return as(uint32_t{});
    default:
      return as(float{});
  }
}

std::vector<uint32_t> unsignedIntegers(const AccessorView& view, int componentType, size_t count) {
  std::vector<uint32_t> out(count);
  const auto as = [&]<typename T>(T value) {
    for (size_t i = 0; i < count; ++i) {
      std::memcpy(&value, view.data + i * view.stride, sizeof value);
      out[i] = value;
    }
    return std::move(out);
  };
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as(uint16_t{});
    default:
      return as(uint32_t{});
  }
}

// Replaces the elements that accessor.sparse lists. replace(element, view of its replacement).
template <typename Replace>
void forEachSparse(const GltfDocument& document, size_t index, Replace replace) {
  const tinygltf::Accessor& accessor = document.model->accessors[index];
  if (!accessor.sparse.isSparse) return;
  // Sparse data is packed, whatever its view says.
  const auto packed = [&](const auto& part, int type, int componentType) {
    const size_t bytes = layoutOf(type, componentType).bytes;
    AccessorView view =
        viewOf(document, part.bufferView, static_cast<size_t>(part.byteOffset), bytes);
    view.stride = bytes;
    return view;
  };
  const auto& sparse = accessor.sparse;
  const auto count = static_cast<size_t>(sparse.count);
  const std::vector<uint32_t> elements =
      unsignedIntegers(packed(sparse.indices, TINYGLTF_TYPE_SCALAR, sparse.indices.componentType),
                       sparse.indices.componentType, count);
  AccessorView value = packed(sparse.values, accessor.type, accessor.componentType);
  for (const uint32_t element : elements) {
    if (element >= accessor.count) {
      document.fail(At{"accessors", index}, "replaces element " + std::to_string(element) + " of " +
                                                std::to_string(accessor.count) +
                                                " by its sparse data");
    }
    replace(element, value);
    value.data += value.stride;
  }
}

// Components that the accessor lacks are 0, 4th ones 1.
template <typename Vec>
std::vector<Vec> readVectors(const GltfDocument& document, size_t index) {
  constexpr size_t kComponents = static_cast<size_t>(Vec::length());
  const tinygltf::Accessor& accessor = document.model->accessors[index];
  const ElementLayout layout = layoutOf(accessor.type, accessor.componentType);
  const size_t n = std::min(kComponents, layout.components);
  Vec lacking(0.0f);
  if (kComponents == 4) lacking[kComponents - 1] = 1.0f;
  std::vector<Vec> out(accessor.count, n < kComponents ? lacking : Vec(0.0f));
  if (out.empty()) return out;
  const AccessorView view =
      viewOf(document, accessor.bufferView, accessor.byteOffset, layout.bytes);
  if (view.data != nullptr) {
    convertAny(accessor, view, n, accessor.count, kComponents, &out[0][0]);
  }
  forEachSparse(document, index, [&](size_t element, const AccessorView& value) {
    convertAny(accessor, value, n, 1, kComponents, &out[element][0]);
  });
  return out;
}

}  // namespace

ElementLayout elementLayout(std::string_view type, size_t componentType) {
  constexpr std::pair<std::string_view, int> kTypes[] = {
      {"SCALAR", TINYGLTF_TYPE_SCALAR}, {"VEC2", TINYGLTF_TYPE_VEC2}, {"VEC3", TINYGLTF_TYPE_VEC3},
      {"VEC4", TINYGLTF_TYPE_VEC4},     {"MAT2", TINYGLTF_TYPE_MAT2}, {"MAT3", TINYGLTF_TYPE_MAT3},
      {"MAT4", TINYGLTF_TYPE_MAT4}};
  // tinygltf also knows a signed 32-bit integer, which glTF has not.
  if (componentType < TINYGLTF_COMPONENT_TYPE_BYTE ||
      componentType > TINYGLTF_COMPONENT_TYPE_FLOAT || componentType == TINYGLTF_COMPONENT_TYPE_INT)
    return {};
  for (const auto& [name, number] : kTypes)
    if (name == type) return layoutOf(number, static_cast<int>(componentType));
  return {};
}

size_t elementCount(const GltfDocument& document, size_t accessor) {
  return document.model->accessors[accessor].count;
}

std::vector<vec2> readVec2(const GltfDocument& document, size_t accessor) {
  return readVectors<vec2>(document, accessor);
}
std::vector<vec3> readVec3(const GltfDocument& document, size_t accessor) {
  return readVectors<vec3>(document, accessor);
}
std::vector<vec4> readVec4(const GltfDocument& document, size_t accessor) {
  return readVectors<vec4>(document, accessor);
}

std::vector<uint32_t> readIndices(const GltfDocument& document, size_t index) {
  const tinygltf::Accessor& accessor = document.model->accessors[index];
  const int type = accessor.componentType;
  const size_t bytes = layoutOf(accessor.type, type).bytes;
  std::vector<uint32_t> out = unsignedIntegers(
      viewOf(document, accessor.bufferView, accessor.byteOffset, bytes), type, accessor.count);
  forEachSparse(document, index, [&](size_t element, const AccessorView& value) {
    out[element] = unsignedIntegers(value, type, 1)[0];
  });
  return out;
}

}  // namespace lamplighter
