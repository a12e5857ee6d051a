#include "renderer/scene/gltf/save/gltf_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <new>

#include "renderer/base/error.h"
#include "renderer/base/text.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

namespace {

const SceneSource& emptySource() {
  static const SceneSource kEmpty;
  return kEmpty;
}

}  // namespace

GltfOutput::GltfOutput(const Scene& savedScene, const std::filesystem::path& target)
    : scene(savedScene),
      source(savedScene.source ? *savedScene.source : emptySource()),
      path(target),
      json(source.document.json) {
  const std::string ending = lowerCase(path.extension().string());
  if (ending != ".gltf" && ending != ".glb") {
    throw InputError(path.string(), "has an unknown extension",
                     "give a name that ends in .gltf or .glb");
  }
  isBinary = ending == ".glb";
  if (!json.is_object()) json = {{"asset", {{"version", "2.0"}, {"generator", "Lamplighter"}}}};
  // An ordered JSON object is a vector of its members. If it grew, references to the lists would
  // dangle, so space is reserved for more lists than glTF has.
  constexpr size_t kMostLists = 32;
  auto& members = json.get_ref<Json::object_t&>();
  members.reserve(members.size() + kMostLists);
}

void GltfOutput::useExtension(const char* name) {
  Json& used = json["extensionsUsed"];
  if (std::find(used.begin(), used.end(), Json(name)) == used.end()) used.push_back(name);
}

const GltfOutput::File* GltfOutput::addedFile(const std::filesystem::path& target) const {
  for (const File& file : files_) {
    if (file.path == target) return &file;
  }
  return nullptr;
}

size_t GltfOutput::append(const char* list, Json entry) {
  json[list].push_back(std::move(entry));
  return json[list].size() - 1;
}

double shortestDouble(float value) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  double out = value;
  if (error == std::errc()) std::from_chars(text.data(), end, out);
  return out;
}

Json toJson(float value) { return shortestDouble(value); }
Json toJson(const vec2& v) { return {toJson(v.x), toJson(v.y)}; }
Json toJson(const vec3& v) { return {toJson(v.x), toJson(v.y), toJson(v.z)}; }
Json toJson(const vec4& v) { return {toJson(v.x), toJson(v.y), toJson(v.z), toJson(v.w)}; }

ScaledColor scaledColor(const vec3& color) {
  const float largest = std::max({color.r, color.g, color.b});
  if (!(largest > 1.0f)) return {toJson(color), 1.0};
  ScaledColor out{Json::array(), shortestDouble(largest)};
  for (int c = 0; c < 3; ++c) {
    out.color.push_back(std::min(shortestDouble(color[c]) / out.scale, 1.0));
  }
  return out;
}

Json& extensionObject(Json& object, const char* name) {
  Json& extensions = object["extensions"];
  if (!extensions.is_object()) extensions = Json::object();
  Json& extension = extensions[name];
  if (!extension.is_object()) extension = Json::object();
  return extension;
}

void eraseExtension(Json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return;
  extensions->erase(name);
  if (extensions->empty()) object.erase("extensions");
}

Json& noteFor(Json& object) {
  Json& extras = object["extras"];
  if (!extras.is_object() && !extras.is_null()) extras = {{"was", extras}};
  if (extras.contains(kExtrasName) && !extras[kExtrasName].is_object()) extras.erase(kExtrasName);
  return extras[kExtrasName];
}

void eraseNote(Json& object, const char* key) {
  if (noteOf(object, key) == nullptr) return;
  Json& ours = object["extras"][kExtrasName];
  ours.erase(key);
  if (ours.empty()) object["extras"].erase(kExtrasName);
  if (object["extras"].empty()) object.erase("extras");
}

namespace {

std::vector<std::filesystem::path> save(const Scene& scene, const std::filesystem::path& path,
                                        bool besideSource) {
  GltfOutput out(scene, path);
  out.besideSource = besideSource;
  out.startBuffers();
  out.carryImages();
  saveTextures(out);
  saveMaterials(out);
  saveMeshes(out);
  const std::vector<size_t> jsonNodes = saveNodes(out);
  saveLights(out, jsonNodes);
  saveSky(out);
  saveBookmarks(out);
  saveSphereMeshes(out, jsonNodes);
  const std::vector<GltfOutput::File> files = out.finish();
  writeFilesAtomically(files);
  std::vector<std::filesystem::path> written;
  for (const GltfOutput::File& file : files) written.push_back(file.path);
  return written;
}

}  // namespace

std::vector<std::filesystem::path> saveGltf(const Scene& scene, const std::filesystem::path& path,
                                            bool besideSource) {
  try {
    return save(scene, path, besideSource);
  } catch (const Json::exception& e) {
    throw InputError(path.string(),
                     "cannot be written: the source file of the scene is malformed (" +
                         printable(e.what()) + ")",
                     "nothing was changed; export the source again");
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), "cannot be written: not enough memory",
                     "nothing was changed; close other programs");
  }
}

}  // namespace lamplighter
