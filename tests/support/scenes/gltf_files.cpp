#include "tests/support/scenes/gltf_files.h"

#include <atomic>
#include <cstring>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace lamplighter::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> count{0};
  path_ = fs::temp_directory_path() /
          ("lamplighter-test-" + std::to_string(getpid()) + "-" + std::to_string(count++));
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& content) const {
  const fs::path path = path_ / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

std::string readText(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

namespace {

std::string word(uint32_t value) {
  std::string out(4, '\0');
  std::memcpy(out.data(), &value, 4);
  return out;
}

template <typename T>
std::string bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// The smallest PNG: one orange pixel.
const std::string kPng(
    "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122"
    "\000\000\000\001\000\000\000\001\010\002\000\000\000\220\167\123"
    "\336\000\000\000\014\111\104\101\124\170\234\143\370\337\240\000"
    "\000\004\041\001\240\115\277\062\220\000\000\000\000\111\105\116"
    "\104\256\102\140\202",
    69);

}  // namespace

std::string glb(const std::string& json, const std::string& binary) {
  std::string text = json, data = binary;
  while (text.size() % 4 != 0) text += ' ';
  while (data.size() % 4 != 0) data += '\0';
  const bool hasData = !data.empty();
  const auto total = static_cast<uint32_t>(20 + text.size() + (hasData ? 8 + data.size() : 0));
  std::string out = word(0x46546c67) + word(2) + word(total);
  out += word(static_cast<uint32_t>(text.size())) + word(0x4e4f534a) + text;
  if (hasData) out += word(static_cast<uint32_t>(data.size())) + word(0x004e4942) + data;
  return out;
}

nlohmann::ordered_json everythingScene(std::string& binary) {
  nlohmann::ordered_json views = nlohmann::ordered_json::array();
  const auto add = [&](const std::string& bytes) {
    while (binary.size() % 4 != 0) binary += '\0';
    views.push_back({{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}});
    binary += bytes;
    return views.size() - 1;
  };
  add(bytesOf<float>({-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1}));     // 0 positions
  add(bytesOf<float>({0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}));         // 1 normals
  add(bytesOf<uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}));  // 2 texture coordinates
  add(bytesOf<uint8_t>({0, 1, 2, 0, 2, 3}));                         // 3 indices
  add(bytesOf<uint16_t>({1, 2}));                                    // 4 sparse indices
  add(bytesOf<float>({5, 0, 1, 5, 0, -1}));                          // 5 sparse values
  add(bytesOf<float>({0, 1}));                                       // 6 times
  add(bytesOf<float>({0, 0, 0, 0, 1, 0}));                           // 7 positions
  add(kPng);                                                         // 8
  auto json = nlohmann::ordered_json::parse(R"({
    "asset": {"version": "2.0", "generator": "by hand", "extras": {"kept": true}},
    "extensionsUsed": ["KHR_lights_punctual", "EXT_lights_area", "XYZ_unheard_of",
                       "KHR_materials_emissive_strength", "KHR_texture_transform"],
    "extensions": {
      "KHR_lights_punctual": {"lights": [
        {"type": "point", "name": "bulb", "color": [1, 0.5, 0.25], "intensity": 40},
        {"type": "spot", "intensity": 3, "range": 7, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.3}}]},
      "EXT_lights_area": {"lights": [
        {"type": "rect", "color": [1, 0.9, 0.8], "intensity": 15, "size": 0.5, "rect": {"aspect": 3}},
        {"type": "disk", "size": 0.3}]},
      "XYZ_unheard_of": {"anything": [1, {"deep": null}]}
    },
    "scene": 0,
    "scenes": [{"name": "the level", "nodes": [0, 4, 5]}, {"name": "another", "nodes": [6, 0]}],
    "nodes": [
      {"name": "root", "children": [1, 2, 3], "translation": [1, 2, 3], "extras": {"mine": 7}},
      {"name": "floor", "mesh": 0, "scale": [2, 1, 2], "rotation": [0, 0.7071068, 0, 0.7071068]},
      {"name": "strip", "mesh": 1, "matrix": [1,0,0,0, 0.5,1,0,0, 0,0,1,0, 0,4,0,1]},
      {"name": "bulb", "extensions": {"KHR_lights_punctual": {"light": 0}, "XYZ_unheard_of": {"x": 1}}},
      {"name": "lamp", "translation": [0, 3, 0], "rotation": [-0.7071068, 0, 0, 0.7071068],
       "extensions": {"EXT_lights_area": {"light": 0}}},
      {"name": "eye", "camera": 0, "translation": [0, 1, 5]},
      {"name": "elsewhere", "mesh": 0, "skin": 0}
    ],
    "meshes": [
      {"name": "square", "primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
        "indices": 3, "material": 0, "extras": {"kept": 1}}]},
      {"name": "bent", "primitives": [{"attributes": {"POSITION": 4}, "mode": 5}]}
    ],
    "materials": [
      {"name": "tiles", "doubleSided": true, "emissiveFactor": [0.5, 0, 0],
       "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.7, 0.6, 1], "metallicFactor": 0,
         "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2], "offset": [0.5, 0]}}}},
       "occlusionTexture": {"index": 0, "strength": 0.5},
       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}, "XYZ_unheard_of": {"y": 2}}}
    ],
    "textures": [{"sampler": 0, "source": 0, "name": "orange"}],
    "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}],
    "images": [{"bufferView": 8, "mimeType": "image/png"}],
    "cameras": [{"type": "perspective", "name": "view", "perspective": {"yfov": 0.9, "znear": 0.1, "aspectRatio": 1.5}}],
    "skins": [{"joints": [1, 3], "name": "bones"}],
    "animations": [{"name": "up", "channels": [{"sampler": 0, "target": {"node": 3, "path": "translation"}},
                                                {"sampler": 0, "target": {"node": 4, "path": "translation"}}],
                    "samplers": [{"input": 5, "output": 6}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5123, "normalized": true, "count": 4, "type": "VEC2"},
      {"bufferView": 3, "componentType": 5121, "count": 6, "type": "SCALAR"},
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
       "sparse": {"count": 2, "indices": {"bufferView": 4, "componentType": 5123}, "values": {"bufferView": 5}}},
      {"bufferView": 6, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
      {"bufferView": 7, "componentType": 5126, "count": 2, "type": "VEC3"}
    ]
  })");
  json["bufferViews"] = std::move(views);
  json["buffers"] = nlohmann::ordered_json::array();
  json["buffers"].push_back({{"byteLength", binary.size()}});
  return json;
}

}  // namespace lamplighter::test
