#include "renderer/scene/gltf/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace lamplighter {

size_t componentSize(size_t componentType) {
  switch (componentType) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

ElementLayout elementLayout(const std::string& type, size_t componentType) {
  const size_t size = componentSize(componentType);
  if (size == 0) return {};
  if (type == "SCALAR") return {1, size};
  if (type == "VEC2") return {2, 2 * size};
  if (type == "VEC3") return {3, 3 * size};
  if (type == "VEC4") return {4, 4 * size};
  // Columns of matrices are aligned to four bytes (glTF 2.0, 3.6.2.4).
  const auto matrix = [&](size_t n) { return ElementLayout{n * n, n * ((n * size + 3) / 4 * 4)}; };
  if (type == "MAT2") return matrix(2);
  if (type == "MAT3") return matrix(3);
  if (type == "MAT4") return matrix(4);
  return {};
}

AccessorView accessorView(const GltfDocument& document, size_t accessor) {
  const At at{"accessors", accessor};
  const Json& json = listOf(document, "accessors")[accessor];
  AccessorView view;
  const size_t type = *sizeMember(document, json, "componentType", at);
  view.count = *sizeMember(document, json, "count", at);
  view.component = static_cast<ComponentType>(type);
  view.layout = elementLayout(textMember(document, json, "type", at), type);
  view.normalized = boolMember(document, json, "normalized", false, at);
  view.stride = view.layout.bytes;
  if (const auto index = sizeMember(document, json, "bufferView", at)) {
    const Json& bufferView = listOf(document, "bufferViews")[*index];
    const At viewAt{"bufferViews", *index};
    const size_t buffer = *sizeMember(document, bufferView, "buffer", viewAt);
    view.data = document.buffers[buffer]->data() +
                sizeMember(document, bufferView, "byteOffset", viewAt).value_or(0) +
                sizeMember(document, json, "byteOffset", at).value_or(0);
    view.stride = sizeMember(document, bufferView, "byteStride", viewAt).value_or(view.stride);
  }
  return view;
}

namespace {

// Converts a component to float.
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

template <typename T>
void convert(const AccessorView& view, size_t components, const uint8_t* data, size_t stride,
             size_t count, float* out) {
  const size_t n = std::min(components, view.layout.components);
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < n; ++c) {
      T value;
      std::memcpy(&value, data + i * stride + c * sizeof(T), sizeof(T));
      out[i * components + c] = toFloat(value, view.normalized);
    }
  }
}

void convertAny(const AccessorView& view, size_t components, const uint8_t* data, size_t stride,
                size_t count, float* out) {
  switch (view.component) {
    case ComponentType::int8:
      return convert<int8_t>(view, components, data, stride, count, out);
    case ComponentType::uint8:
      return convert<uint8_t>(view, components, data, stride, count, out);
    case ComponentType::int16:
      return convert<int16_t>(view, components, data, stride, count, out);
    case ComponentType::uint16:
      return convert<uint16_t>(view, components, data, stride, count, out);
    case ComponentType::uint32:
      return convert<uint32_t>(view, components, data, stride, count, out);
    case ComponentType::float32:
      return convert<float>(view, components, data, stride, count, out);
  }
}

std::vector<uint32_t> unsignedIntegers(const uint8_t* data, ComponentType type, size_t stride,
                                       size_t count) {
  std::vector<uint32_t> out(count);
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* p = data + i * stride;
    switch (type) {
      case ComponentType::uint8:
        out[i] = *p;
        break;
      case ComponentType::uint16: {
        uint16_t value;
        std::memcpy(&value, p, sizeof value);
        out[i] = value;
        break;
      }
      default:
        std::memcpy(&out[i], p, sizeof out[i]);
    }
  }
  return out;
}

// Replaces the elements that accessor.sparse lists. replace(element, source, first replacement).
template <typename Replace>
void forEachSparse(const GltfDocument& document, size_t accessor, const AccessorView& view,
                   Replace replace) {
  const Json* sparse = member(listOf(document, "accessors")[accessor], "sparse");
  if (sparse == nullptr) return;
  const At at{"accessors", accessor};
  const auto source = [&](const Json& part) {
    const size_t index = *sizeMember(document, part, "bufferView", at);
    const Json& bufferView = listOf(document, "bufferViews")[index];
    const size_t buffer = *sizeMember(document, bufferView, "buffer", at);
    return document.buffers[buffer]->data() +
           sizeMember(document, bufferView, "byteOffset", at).value_or(0) +
           sizeMember(document, part, "byteOffset", at).value_or(0);
  };
  const size_t count = *sizeMember(document, *sparse, "count", at);
  const Json& indices = *member(*sparse, "indices");
  const size_t type = *sizeMember(document, indices, "componentType", at);
  const std::vector<uint32_t> elements = unsignedIntegers(
      source(indices), static_cast<ComponentType>(type), componentSize(type), count);
  const uint8_t* values = source(*member(*sparse, "values"));
  for (size_t i = 0; i < count; ++i) {
    if (elements[i] >= view.count) {
      document.fail(at,
                    "replaces element " + std::to_string(elements[i]) + " of " +
                        std::to_string(view.count) + " by its sparse data",
                    kExportAgain);
    }
    replace(elements[i], values + i * view.layout.bytes);
  }
}

template <typename Vec>
std::vector<Vec> readVectors(const GltfDocument& document, size_t accessor) {
  constexpr size_t kComponents = static_cast<size_t>(Vec::length());
  const std::vector<float> floats = readFloats(document, accessor, kComponents);
  std::vector<Vec> out(floats.size() / kComponents);
  if (!out.empty()) std::memcpy(&out[0][0], floats.data(), floats.size() * sizeof(float));
  return out;
}

}  // namespace

std::vector<float> readFloats(const GltfDocument& document, size_t accessor, size_t components) {
  const AccessorView view = accessorView(document, accessor);
  std::vector<float> out(view.count * components, 0.0f);
  if (components == 4 && view.layout.components < 4) {
    for (size_t i = 3; i < out.size(); i += 4) out[i] = 1.0f;
  }
  if (view.data != nullptr) {
    convertAny(view, components, view.data, view.stride, view.count, out.data());
  }
  forEachSparse(document, accessor, view, [&](size_t element, const uint8_t* value) {
    convertAny(view, components, value, view.layout.bytes, 1, &out[element * components]);
  });
  return out;
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

std::vector<uint32_t> readIndices(const GltfDocument& document, size_t accessor) {
  const AccessorView view = accessorView(document, accessor);
  std::vector<uint32_t> out(view.count, 0);
  if (view.data != nullptr) {
    out = unsignedIntegers(view.data, view.component, view.stride, view.count);
  }
  forEachSparse(document, accessor, view, [&](size_t element, const uint8_t* value) {
    out[element] = unsignedIntegers(value, view.component, view.layout.bytes, 1)[0];
  });
  return out;
}

}  // namespace lamplighter
