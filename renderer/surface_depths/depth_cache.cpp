#include "renderer/surface_depths/depth_cache.h"

#include <algorithm>

namespace lamplighter {

std::optional<ContentKey> DepthCache::keyOf(const RenderScene& scene, const TexelSet& texels,
                                            const DepthMapLayout& layout) {
  ContentHash hash;
  hash.add(static_cast<uint64_t>(layout.kind));
  hash.add(static_cast<uint64_t>(layout.resolution));
  hash.add(scene.bounds.radius());
  for (const RenderObject& o : scene.objects) {
    if (o.isAreaLight || o.isEmpty()) continue;
    const Material& m = scene.materials[static_cast<size_t>(o.material)];
    if (m.alphaMode == AlphaMode::mask) return std::nullopt;
    hash.add(static_cast<uint64_t>(m.doubleSided) << 1 | static_cast<uint64_t>(m.isClear()));
    hash.add(uint64_t{o.indexCount});
    for (uint32_t i = o.firstIndex; i < o.firstIndex + o.indexCount; ++i)
      hash.add(scene.positions[scene.indices[i]]);
  }
  hash.add(uint64_t{texels.size()});
  for (size_t t = 0; t < texels.size(); ++t) {
    hash.add(texels[t].spot.position);
    hash.add(texels[t].spot.geometricNormal);
  }
  return hash.key();
}

bool DepthCache::load(const ContentKey& key, SurfaceDepths& depths) const {
  const auto bytes = files_.load(key);
  return bytes && depths.restore(*bytes);
}

void DepthCache::save(const ContentKey& key, const SurfaceDepths& depths) const {
  if (files_.save(key, depths.saved())) files_.keepWithin(kMostBytes);
}

}  // namespace lamplighter
