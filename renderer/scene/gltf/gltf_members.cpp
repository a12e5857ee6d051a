// The members that are read, as a table: what type each must have, and what it refers to.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

namespace {

enum class Type { count, index, number, numbers, flag, text, array, textureInfo };

// A member and where it is in an entry of a list: names with a dot between; [] is every entry of
// an array, {} every member of an object.
struct Member {
  std::string_view path;
  Type type;
  const char* list = nullptr;  // which an index refers to
  size_t length = 0;           // of numbers
  bool isRequired = false;
};

constexpr Member required(Member member) {
  member.isRequired = true;
  return member;
}
constexpr Member index(std::string_view path, const char* list) {
  return {path, Type::index, list};
}
constexpr Member numbers(std::string_view path, size_t length) {
  return {path, Type::numbers, nullptr, length};
}

constexpr Member kRoot[] = {{"scene", Type::count}};
constexpr Member kBuffers[] = {required({"byteLength", Type::count}), {"uri", Type::text}};
constexpr Member kViews[] = {required(index("buffer", "buffers")),
                             required({"byteLength", Type::count}),
                             {"byteOffset", Type::count},
                             {"byteStride", Type::count}};
constexpr Member kAccessors[] = {required({"componentType", Type::count}),
                                 required({"count", Type::count}),
                                 required({"type", Type::text}),
                                 {"byteOffset", Type::count},
                                 {"normalized", Type::flag},
                                 index("bufferView", "bufferViews")};
// Of sparse.indices and sparse.values.
constexpr Member kSparse[] = {
    required({"sparse.count", Type::count}),
    required({"sparse.indices.componentType", Type::count}),
    required(index("sparse.indices.bufferView", "bufferViews")),
    {"sparse.indices.byteOffset", Type::count},
    required(index("sparse.values.bufferView", "bufferViews")),
    {"sparse.values.byteOffset", Type::count},
};
constexpr Member kImages[] = {index("bufferView", "bufferViews"), {"uri", Type::text}};
constexpr Member kSamplers[] = {
    {"wrapS", Type::count}, {"wrapT", Type::count}, {"magFilter", Type::count}};
constexpr Member kTextures[] = {
    {"name", Type::text},
    index("sampler", "samplers"),
    index("source", "images"),
    index("extensions.EXT_texture_webp.source", "images"),
    index("extensions.KHR_texture_basisu.source", "images"),
    index("extensions.EXT_texture_avif.source", "images"),
    index("extensions.MSFT_texture_dds.source", "images"),
};
constexpr Member kTextureInfo[] = {
    index("index", "textures"),
    {"texCoord", Type::count},
    {"scale", Type::number},
    numbers("extensions.KHR_texture_transform.offset", 2),
    numbers("extensions.KHR_texture_transform.scale", 2),
    {"extensions.KHR_texture_transform.rotation", Type::number},
    {"extensions.KHR_texture_transform.texCoord", Type::count},
};
constexpr Member kMaterials[] = {
    {"name", Type::text},
    numbers("pbrMetallicRoughness.baseColorFactor", 4),
    {"pbrMetallicRoughness.metallicFactor", Type::number},
    {"pbrMetallicRoughness.roughnessFactor", Type::number},
    {"pbrMetallicRoughness.baseColorTexture", Type::textureInfo},
    {"pbrMetallicRoughness.metallicRoughnessTexture", Type::textureInfo},
    {"normalTexture", Type::textureInfo},
    {"emissiveTexture", Type::textureInfo},
    numbers("emissiveFactor", 3),
    {"extensions.KHR_materials_emissive_strength.emissiveStrength", Type::number},
    {"extensions.KHR_materials_transmission.transmissionFactor", Type::number},
    {"alphaMode", Type::text},
    {"alphaCutoff", Type::number},
    {"doubleSided", Type::flag},
};
constexpr Member kMeshes[] = {
    {"name", Type::text},
    {"weights", Type::array},
    index("primitives[].attributes{}", "accessors"),
    index("primitives[].targets[]{}", "accessors"),
    index("primitives[].indices", "accessors"),
    index("primitives[].material", "materials"),
    {"primitives[].mode", Type::count},
};
constexpr Member kCameras[] = {
    {"name", Type::text},
    {"perspective.yfov", Type::number},
    {"perspective.aspectRatio", Type::number},
    {"perspective.znear", Type::number},
    {"perspective.zfar", Type::number},
};
constexpr Member kSkins[] = {
    index("joints[]", "nodes"),
    index("skeleton", "nodes"),
    index("inverseBindMatrices", "accessors"),
};
constexpr Member kAnimations[] = {
    index("samplers[].input", "accessors"),
    index("samplers[].output", "accessors"),
    {"channels[].sampler", Type::count},
    index("channels[].target.node", "nodes"),
};
constexpr Member kNodes[] = {
    {"name", Type::text},
    index("mesh", "meshes"),
    index("camera", "cameras"),
    index("skin", "skins"),
    index("children[]", "nodes"),
    numbers("matrix", 16),
    numbers("translation", 3),
    numbers("rotation", 4),
    numbers("scale", 3),
    index("extensions.KHR_lights_punctual.light", kPunctualLights),
    index("extensions.EXT_lights_area.light", kAreaLights),
    {"extensions.KHR_node_visibility.visible", Type::flag},
    {"extras.lamplighter.areaLight.shape", Type::text},
    numbers("extras.lamplighter.areaLight.radiance", 3),
    {"extras.lamplighter.areaLight.diameter", Type::number},
    {"extras.lamplighter.areaLight.length", Type::number},
    {"extras.lamplighter.light.on", Type::flag},
    {"extras.lamplighter.light.solo", Type::flag},
    {"extras.lamplighter.light.group", Type::text},
    {"extras.lamplighter.light.leaves_out[]", Type::index, "nodes"},
    {"extras.lamplighter.light.profile", Type::text},
    {"extras.lamplighter.light.picture", Type::text},
};
constexpr Member kScenes[] = {
    {"name", Type::text},
    index("nodes[]", "nodes"),
    {"extras.lamplighter.lights.sky.on", Type::flag},
    {"extras.lamplighter.lights.sky.solo", Type::flag},
    {"extras.lamplighter.lights.sky.group", Type::text},
    {"extras.lamplighter.lights.sky.leaves_out[]", Type::index, "nodes"},
    {"extras.lamplighter.lights.groups[].name", Type::text},
    {"extras.lamplighter.lights.groups[].muted", Type::flag},
    {"extras.lamplighter.lights.groups[].solo", Type::flag},
};
constexpr Member kPunctual[] = {
    {"type", Type::text},
    numbers("color", 3),
    {"intensity", Type::number},
    {"range", Type::number},
    {"spot.innerConeAngle", Type::number},
    {"spot.outerConeAngle", Type::number},
};
constexpr Member kArea[] = {
    {"type", Type::text},   numbers("color", 3),           {"intensity", Type::number},
    {"size", Type::number}, {"rect.aspect", Type::number},
};

struct List {
  const char* name;
  std::span<const Member> members;
};
constexpr List kLists[] = {
    {"buffers", kBuffers},     {"bufferViews", kViews},      {"accessors", kAccessors},
    {"images", kImages},       {"samplers", kSamplers},      {"textures", kTextures},
    {"materials", kMaterials}, {"meshes", kMeshes},          {"cameras", kCameras},
    {"skins", kSkins},         {"animations", kAnimations},  {"nodes", kNodes},
    {"scenes", kScenes},       {kPunctualLights, kPunctual}, {kAreaLights, kArea},
};

bool isFinite(const Json& value) {
  return value.is_number() &&
         std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
}

class EntryCheck {
 public:
  EntryCheck(const GltfDocument& document, At at) : doc_(document), at_(at) {}

  void check(const Json& entry, const Member& member) const { walk(entry, member.path, member); }

 private:
  // `path` from `object` on.
  void walk(const Json& object, std::string_view path, const Member& m) const {
    const size_t end = std::min(path.find_first_of(".[{"), path.size());
    const std::string_view key = path.substr(0, end);
    const Json* value = object.is_object() ? find(object, key) : nullptr;
    std::string_view rest = path.substr(end);
    if (value == nullptr) {
      if (m.isRequired) doc_.fail(at_, "has no \"" + std::string(key) + "\"", kExportAgain);
      return;
    }
    step(*value, key, rest, m);
  }

  void step(const Json& value, std::string_view key, std::string_view rest, const Member& m) const {
    if (rest.empty()) return leaf(value, key, m);
    if (rest.starts_with('.')) return walk(value, rest.substr(1), m);
    const bool isArray = rest.starts_with("[]");
    if (isArray ? !value.is_array() : !value.is_object()) {
      wrongType(value, key, isArray ? "array" : "object");
    }
    rest.remove_prefix(2);
    for (const auto& [name, entry] : value.items()) {
      if (isArray && rest.empty()) {
        amongIndices(entry, key, m);
      } else {
        step(entry, isArray ? key : std::string_view(name), rest, m);
      }
    }
  }

  static const Json* find(const Json& object, std::string_view key) {
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
  }

  void leaf(const Json& value, std::string_view key, const Member& m) const {
    switch (m.type) {
      case Type::count:
        size(value, key);
        break;
      case Type::index: {
        const size_t count = listOf(doc_, m.list).size();
        if (const size_t i = size(value, key); i >= count) {
          doc_.fail(at_,
                    "has \"" + printable(key) + "\": " + std::to_string(i) + ", but there are " +
                        std::to_string(count),
                    kExportAgain);
        }
        break;
      }
      case Type::number:
        if (!isFinite(value)) wrongType(value, key, "finite number");
        break;
      case Type::numbers:
        if (!value.is_array() || value.size() != m.length ||
            !std::all_of(value.begin(), value.end(), isFinite)) {
          wrongType(value, key, std::to_string(m.length) + " finite numbers");
        }
        break;
      case Type::flag:
        if (!value.is_boolean()) wrongType(value, key, "true or false");
        break;
      case Type::text:
        if (!value.is_string()) wrongType(value, key, "text");
        break;
      case Type::array:
        if (!value.is_array()) wrongType(value, key, "array");
        break;
      case Type::textureInfo:
        for (const Member& part : kTextureInfo) walk(value, part.path, part);
    }
  }

  size_t size(const Json& value, std::string_view key) const {
    const auto number = sizeOf(value);
    if (!number) wrongType(value, key, "count or index");
    return *number;
  }

  void amongIndices(const Json& value, std::string_view key, const Member& m) const {
    const size_t count = listOf(doc_, m.list).size();
    const auto number = sizeOf(value);
    if (number && *number < count) return;
    doc_.fail(at_,
              "has " + printable(value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                  " among its \"" + std::string(key) + "\", but there are " + std::to_string(count),
              kExportAgain);
  }

  [[noreturn]] void wrongType(const Json& value, std::string_view key,
                              const std::string& expected) const {
    doc_.fail(at_,
              "has \"" + printable(key) +
                  "\": " + printable(value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                  ", which is no " + expected,
              kExportAgain);
  }

  const GltfDocument& doc_;
  At at_;
};

}  // namespace

std::optional<size_t> sizeOf(const Json& value) {
  if (value.is_number_unsigned()) return value.get<size_t>();
  // Some exporters write 3.0 where 3 is meant.
  if (value.is_number_float()) {
    const double d = value.get<double>();
    if (!std::signbit(d) && d < 9007199254740992.0 && d == std::floor(d))
      return static_cast<size_t>(d);
  }
  return std::nullopt;
}

void checkMembers(const GltfDocument& document) {
  for (const Member& member : kRoot) EntryCheck(document, {"glTF", 0}).check(document.json, member);
  for (const List& list : kLists) {
    const Json& entries = listOf(document, list.name);
    for (size_t i = 0; i < entries.size(); ++i) {
      const EntryCheck entry(document, {list.name, i});
      for (const Member& member : list.members) entry.check(entries[i], member);
      if (entries[i].contains("sparse")) {
        for (const Member& member : kSparse) entry.check(entries[i], member);
      }
    }
  }
}

}  // namespace lamplighter
