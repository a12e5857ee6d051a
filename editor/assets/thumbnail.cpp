#include "editor/assets/thumbnail.h"

#include <cmath>
#include <fstream>

#include <spdlog/fmt/fmt.h>

#include "editor/input/recording.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/gltf/referenced_files.h"

namespace lamplighter {

namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 3;  // per side of a pixel
// Increase when thumbnails change, so that cached ones are no longer used.
constexpr int kThumbnailVersion = 1;

// A view from the front, slightly from the right and from above, that shows all of `bounds`.
View viewOf(const Bounds& bounds, int size) {
  View view;
  view.width = view.height = size;
  view.yfov = 0.5f;
  view.orientation = glm::angleAxis(0.6f, vec3(0, 1, 0)) * glm::angleAxis(-0.45f, vec3(1, 0, 0));
  const float radius = std::max(bounds.radius(), 1e-4f);
  const float distance = radius / std::sin(0.5f * view.yfov);
  view.eye = bounds.centre() - distance * view.forward();
  view.znear = std::max(1e-5f, 0.01f * (distance - radius));
  return view;
}

// Hash of the file's bytes and of the modification times of the files it references. Textures can
// change while the file stays the same.
uint64_t hashOfAsset(const fs::path& file) {
  uint64_t hash = fileHash(file);
  for (const FileStamp& stamp : referencedFiles(file)) {
    for (const uint64_t part : {stamp.size, static_cast<uint64_t>(stamp.modified)})
      hash = hashedWith(hash, part);
  }
  return hash;
}

}  // namespace

Image8 renderThumbnail(const fs::path& file, int size) {
  const LoadedScene loaded = loadGltf(file);
  RenderScene world;
  update(world, loaded.scene, SceneChanges::all());
  Image8 out(size, size);
  std::fill(out.pixels.begin(), out.pixels.end(), uint8_t{0});
  if (world.bounds.empty()) return out;
  const RayCaster rays(world);
  const View view = viewOf(world.bounds, kSamples * size);
  const Inspection nothing;
  const Image8 fine = drawView(DebugView::flat, {world, rays, view, nothing}).image;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      int sum[3] = {0, 0, 0}, hits = 0;
      for (int i = 0; i < kSamples * kSamples; ++i) {
        const int fx = kSamples * x + i % kSamples, fy = kSamples * y + i / kSamples;
        const vec3 direction =
            view.rayDirection(static_cast<float>(fx) + 0.5f, static_cast<float>(fy) + 0.5f);
        if (!rays.intersect({view.eye, 0.0f, direction}, Surfaces::seen)) continue;
        ++hits;
        for (int c = 0; c < 3; ++c) sum[c] += fine.at(fx, fy)[c];
      }
      if (hits == 0) continue;
      for (int c = 0; c < 3; ++c) out.at(x, y)[c] = static_cast<uint8_t>(sum[c] / hits);
      out.at(x, y)[3] = static_cast<uint8_t>(255 * hits / (kSamples * kSamples));
    }
  }
  return out;
}

Image8 cachedThumbnail(const fs::path& file, int size, const fs::path& cacheFolder) {
  if (cacheFolder.empty()) return renderThumbnail(file, size);
  const fs::path cached = cacheFolder / fmt::format("{}-{}-{}.png", hashText(hashOfAsset(file)),
                                                    size, kThumbnailVersion);
  std::error_code error;
  if (fs::exists(cached, error)) {
    std::string why;
    std::vector<uint8_t> bytes;
    std::ifstream in(cached, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
    // Renders it again if another program damaged the file.
    if (auto image = decodeImage8(bytes, why); image && image->width == size) return *image;
  }
  Image8 image = renderThumbnail(file, size);
  fs::create_directories(cacheFolder, error);
  try {
    writePng(image, cached);
  } catch (const InputError&) {
    // The write failed; it is rendered again next time.
  }
  return image;
}

}  // namespace lamplighter
