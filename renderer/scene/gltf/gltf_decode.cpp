// The checked JSON as tinygltf reads it.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <tiny_gltf.h>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

namespace {

// Members that are not passed to tinygltf: extensions and extras are read from the JSON, the others
// are not used.
constexpr std::string_view kLeftOut[] = {"extensions", "extras", "min", "max", "target", "targets"};

void appendText(std::string& out, const std::string& text) {
  const bool isPlain = std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\';
  });
  out += isPlain ? '"' + text + '"' : Json(text).dump();
}

// The shortest text that is read back unchanged: 3 for 3.0, because tinygltf accepts only integers
// as counts.
void appendNumber(std::string& out, double number) {
  char text[32];
  out.append(text, std::to_chars(text, std::end(text), number).ptr);
  if (number == 0.0 && std::signbit(number)) out += ".0";  // -0 would be the integer
}

// As JSON, without the members of kLeftOut. Not by dump() of a copy, which takes as long as
// tinygltf itself.
void append(std::string& out, const Json& value) {
  char separator = value.is_object() ? '{' : '[';
  if (value.is_object()) {
    for (const auto& [key, entry] : value.get_ref<const Json::object_t&>()) {
      if (std::find(std::begin(kLeftOut), std::end(kLeftOut), key) != std::end(kLeftOut)) continue;
      out += std::exchange(separator, ',');
      appendText(out, key);
      out += ':';
      append(out, entry);
    }
    out += separator == '{' ? "{}" : "}";
  } else if (value.is_array()) {
    for (const Json& entry : value) {
      out += std::exchange(separator, ',');
      append(out, entry);
    }
    out += separator == '[' ? "[]" : "]";
  } else if (value.is_string()) {
    appendText(out, value.get_ref<const std::string&>());
  } else if (value.is_number_float()) {
    appendNumber(out, value.get<double>());
  } else {
    out += value.dump();
  }
}

// Buffers whose URI is their index; readBuffer() maps it to the data.
Json buffersOf(const Json& buffers) {
  Json out = Json::array();
  for (const Json& buffer : buffers) {
    const size_t length = std::max<size_t>(sizeIn(buffer, "byteLength"), 1);
    out.push_back({{"uri", std::to_string(out.size())}, {"byteLength", length}});
  }
  return out;
}

// Every camera as a perspective camera with all required members.
Json camerasOf(const Json& cameras) {
  Json out = Json::array();
  for (const Json& camera : cameras) {
    Json lens = {{"yfov", Camera().yfov}, {"znear", Camera().znear}};
    const Json* given = member(camera, "perspective");
    if (given != nullptr && given->is_object()) lens.update(*given);
    out.push_back(
        {{"type", "perspective"}, {"name", textIn(camera, "name")}, {"perspective", lens}});
  }
  return out;
}

// Lights with the members that tinygltf insists on.
Json lightsOf(Json lights) {
  for (Json& light : lights) {
    light["type"] = textIn(light, "type");
    if (!light.contains("spot") || !light["spot"].is_object()) light["spot"] = Json::object();
  }
  return lights;
}

// What tinygltf is given of the document.
std::string decodable(const GltfDocument& document) {
  std::string out =
      R"({"asset":{"version":"2.0"},"scene":)" + std::to_string(sizeIn(document.json, "scene"));
  const auto add = [&](const char* name, const Json& list) {
    out += std::string(",\"") + name + "\":";
    append(out, list);
  };
  add("buffers", buffersOf(listOf(document, "buffers")));
  add("cameras", camerasOf(listOf(document, "cameras")));
  for (const char* list : {"bufferViews", "accessors", "samplers", "textures", "materials",
                           "meshes", "nodes", "scenes"}) {
    add(list, listOf(document, list));
  }
  out += R"(,"extensions":{"KHR_lights_punctual":{"lights":)";
  append(out, lightsOf(listOf(document, kPunctualLights)));
  return out + "}}}";
}

// What tinygltf reads instead of a file: data in the URI, a file in the document's folder or the
// binary chunk. `user` is the document.
bool readBuffer(std::vector<unsigned char>* out, std::string*, const std::string& name,
                void* user) {
  GltfDocument& document = *static_cast<GltfDocument*>(user);
  const At at{"buffers", std::stoul(name)};
  const Json& json = listOf(document, "buffers")[at.index];
  NewBytes bytes;
  if (member(json, "uri") == nullptr) {
    // Only the first buffer may be the binary chunk. EXT_meshopt_compression has buffers without
    // any bytes, for loaders that know it.
    if (at.index == 0) bytes = std::move(document.binaryChunk);
    if (bytes == nullptr) {
      document.fail(at, "has neither a uri nor the binary chunk of a .glb");
    }
  } else {
    std::string why;
    const std::string uri = textIn(json, "uri");
    bytes = readUri(document, uri, why);
    if (bytes == nullptr) {
      document.fail(at, "names \"" + printable(uri) + "\", which " + why,
                    "put the file beside the scene, or export the scene as one .glb");
    }
    document.bytesRead += bytes->size();
  }
  const size_t length = sizeIn(json, "byteLength");
  if (bytes->size() < length) {
    document.fail(at,
                  "has " + std::to_string(bytes->size()) + " bytes where " +
                      std::to_string(length) + " are stated",
                  "copy or export it again");
  }
  bytes->resize(std::max<size_t>(length, 1));
  out->swap(*bytes);
  return true;
}

}  // namespace

void decodeModel(GltfDocument& document) {
  tinygltf::TinyGLTF reader;
  reader.SetFsCallbacks({[](const std::string&, void*) { return true; },
                         [](const std::string& name, void*) { return name; }, readBuffer, nullptr,
                         &document});
  const std::string text = decodable(document);
  tinygltf::Model model;
  std::string error, warning;
  if (!reader.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                  static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE)) {
    document.fail("cannot be decoded (" + printable(error) + ")");
  }
  for (tinygltf::Buffer& buffer : model.buffers) {
    document.buffers.push_back(
        std::make_shared<const std::vector<uint8_t>>(std::move(buffer.data)));
  }
  model.buffers.clear();
  document.model = std::make_shared<const tinygltf::Model>(std::move(model));
}

}  // namespace lamplighter
