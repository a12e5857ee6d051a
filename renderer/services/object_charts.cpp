#include "renderer/services/object_charts.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

std::span<const uint32_t> indicesOf(const RenderScene& scene, const RenderObject& o) {
  return std::span(scene.indices).subspan(o.firstIndex, o.indexCount);
}

// Density in own space. The scale is rounded to steps of 1/256 to 1/512, so that rounding errors of
// a rotation do not change the layout.
float densityOf(const OwnSpace& space, float texelsPerMetre) {
  int exponent = 0;
  const float mantissa = std::frexp(space.scale, &exponent);
  return texelsPerMetre * std::ldexp(std::round(mantissa * 512.0f) / 512.0f, exponent);
}

ContentKey keyOf(const RenderScene& scene, const RenderObject& o, const OwnSpace& space,
                 float texelsPerMetre) {
  ContentHash hash;
  hash.add(densityOf(space, texelsPerMetre));
  for (int c = 0; c < 3; ++c) hash.add(space.stretch[c]);
  hash.add(uint64_t{o.vertexCount});
  for (uint32_t i = 0; i < o.vertexCount; ++i) hash.add(scene.localPositions[o.firstVertex + i]);
  hash.add(uint64_t{o.indexCount});
  for (const uint32_t i : indicesOf(scene, o)) hash.add(uint64_t{i - o.firstVertex});
  return hash.key();
}

MeshAtlas computeAtlas(const RenderScene& scene, const RenderObject& o, const OwnSpace& space,
                       float texelsPerMetre) {
  std::vector<vec3> positions(o.vertexCount);
  for (uint32_t i = 0; i < o.vertexCount; ++i)
    positions[i] = space.stretch * scene.localPositions[o.firstVertex + i];
  std::vector<uint32_t> indices;
  indices.reserve(o.indexCount);
  for (const uint32_t i : indicesOf(scene, o)) indices.push_back(i - o.firstVertex);
  return makeMeshAtlas(positions, indices, densityOf(space, texelsPerMetre));
}

}  // namespace

// Sets the space and the key of an object.
void ObjectCharts::place(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  const std::optional<OwnSpace> space = o.isAreaLight || o.isEmpty() ? std::nullopt : ownSpaceOf(o);
  const OwnSpace before = std::exchange(objects_[object].space, space.value_or(OwnSpace()));
  const bool isSame = keys_[object] && space && before.stretch == space->stretch &&
                      densityOf(before, 1.0f) == densityOf(*space, 1.0f);
  if (isSame) return;
  keys_[object].reset();
  if (space) keys_[object] = keyOf(scene, o, *space, texelsPerMetre_);
}

std::span<const ObjectAtlas> ObjectCharts::find(const RenderScene& scene, float texelsPerMetre) {
  const RenderSceneChanges changes = std::exchange(changes_, {});
  if (changes.rebuilt || texelsPerMetre != texelsPerMetre_) {
    texelsPerMetre_ = texelsPerMetre;
    objects_.assign(scene.objects.size(), {});
    keys_.assign(scene.objects.size(), {});
    tbb::parallel_for(size_t{0}, keys_.size(),
                      [&](size_t i) { place(scene, static_cast<uint32_t>(i)); });
  } else if (changes.movedObjects.empty()) {
    return objects_;
  } else {
    objects_.resize(scene.objects.size());
    keys_.resize(scene.objects.size());
    for (const uint32_t object : changes.movedObjects) place(scene, object);
  }

  struct Missing {
    uint32_t object;
    ContentKey key;
    std::shared_ptr<const MeshAtlas> atlas;
    bool isComputed = false;
  };
  std::vector<Missing> missing;
  std::map<ContentKey, std::shared_ptr<const MeshAtlas>> used;
  for (uint32_t i = 0; i < keys_.size(); ++i) {
    if (!keys_[i] || used.contains(*keys_[i])) continue;
    const auto known = known_.find(*keys_[i]);
    used.emplace(*keys_[i], known == known_.end() ? nullptr : known->second);
    if (known == known_.end()) missing.push_back({i, *keys_[i], nullptr});
  }
  tbb::parallel_for(size_t{0}, missing.size(), [&](size_t i) {
    Missing& m = missing[i];
    const RenderObject& o = scene.objects[m.object];
    std::optional<MeshAtlas> atlas;
    if (const auto bytes = files_.load(m.key)) atlas = meshAtlasOf(*bytes, o.triangleCount());
    m.isComputed = !atlas;
    if (!atlas) {
      atlas = computeAtlas(scene, o, objects_[m.object].space, texelsPerMetre_);
      files_.save(m.key, bytesOf(*atlas));
    }
    m.atlas = std::make_shared<const MeshAtlas>(std::move(*atlas));
  });
  for (Missing& m : missing) {
    used[m.key] = std::move(m.atlas);
    computed_ += m.isComputed;
  }
  if (std::any_of(missing.begin(), missing.end(), [](const Missing& m) { return m.isComputed; }))
    files_.keepWithin(kMostBytes);
  known_ = std::move(used);
  for (size_t i = 0; i < keys_.size(); ++i)
    objects_[i].atlas = keys_[i] ? known_.at(*keys_[i]) : nullptr;
  return objects_;
}

}  // namespace lamplighter
