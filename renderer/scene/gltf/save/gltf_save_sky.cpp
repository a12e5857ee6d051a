// Saves the sky as a note on the scene, and its picture as a file beside it
// (docs/reference/gltf.md).
#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

namespace fs = std::filesystem;

// The URI of the picture's file, which is added to the output if it does not exist.
std::string pictureUri(GltfOutput& out, const SkyImage& image) {
  const auto& loaded = out.source.sky.image;
  if (loaded != nullptr && loaded->hash == image.hash && out.isSameFolder()) {
    const Json& scenes = listOf(out.source.document, "scenes");
    const size_t index = out.source.document.json.value("scene", size_t{0});
    return noteOf(scenes[index], kSkyNote)->at("uri").get<std::string>();
  }
  if (image.file == nullptr) {
    throw InputError(out.path.string(), "cannot be written: the picture of the sky has no file",
                     "choose a picture file for the sky");
  }
  return uriOfFile(out, image.name.empty() ? "sky.exr" : image.name, *image.file);
}

Json noteOfSky(GltfOutput& out, const Sky& sky) {
  switch (sky.kind) {
    case SkyKind::constant:
      return {{"type", "constant"}, {"radiance", toJson(sky.radiance)}};
    case SkyKind::gradient:
      return {{"type", "gradient"},
              {"zenith", toJson(sky.zenith)},
              {"horizon", toJson(sky.horizon)},
              {"ground", toJson(sky.ground)}};
    case SkyKind::image:
      break;
  }
  return {{"type", "image"},
          {"uri", pictureUri(out, *sky.image)},
          {"rotation", toJson(sky.rotation)},
          {"scale", toJson(sky.scale)}};
}

}  // namespace

std::string uriOfFile(GltfOutput& out, const fs::path& name, std::span<const uint8_t> bytes) {
  // Does not overwrite a different file with this name.
  for (int i = 0;; ++i) {
    const std::string free =
        name.stem().string() + (i == 0 ? "" : "-" + std::to_string(i)) + name.extension().string();
    if (free == out.path.filename().string()) continue;
    const fs::path target = out.path.parent_path() / free;
    const GltfOutput::File* added = out.addedFile(target);
    if (added != nullptr) {
      if (std::equal(bytes.begin(), bytes.end(), added->bytes.begin(), added->bytes.end()))
        return percentEncoded(free);
      continue;
    }
    std::error_code error;
    if (!fs::exists(target, error)) {
      out.addFile({target, {bytes.begin(), bytes.end()}});
      return percentEncoded(free);
    }
    std::string why;
    const bool isSameSize = fs::file_size(target, error) == bytes.size() && !error;
    const Bytes there = isSameSize ? readWholeFile(target, why) : nullptr;
    if (there != nullptr && std::equal(bytes.begin(), bytes.end(), there->begin(), there->end()))
      return percentEncoded(free);
  }
}

void saveSky(GltfOutput& out) {
  const Scene& now = out.scene;
  const bool isSame = now.sky == out.source.sky && now.skyIsDefault == out.source.skyIsDefault;
  if (isSame && (now.sky.kind != SkyKind::image || out.isSameFolder())) return;
  // Without a note, a scene without light would be loaded with the default sky.
  const bool isNoted = !now.skyIsDefault && (!now.sky.isBlack() || !hasLight(now));
  if (!isNoted && !out.json.contains("scenes")) return;
  Json& scene = out.json["scenes"][out.json.value("scene", size_t{0})];
  eraseNote(scene, kSkyNote);
  if (isNoted) noteFor(scene)[kSkyNote] = noteOfSky(out, now.sky);
}

}  // namespace lamplighter
