#include "renderer/light_field/field_surface.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Search radius for the nearest texel at points without a texel [texels].
constexpr int kTexelReach = kGutter + 1;

// The texel nearest to the centre of a cell of a rectangle, preferably one that is not buried.
uint32_t nearestTexel(const TexelSet& texels, const TexelSet::Part& part, int x, int y) {
  uint32_t best = TexelSet::kNone;
  int bestFar = 0;
  bool bestIsBuried = true;
  for (int dy = -kTexelReach; dy <= kTexelReach; ++dy) {
    for (int dx = -kTexelReach; dx <= kTexelReach; ++dx) {
      const int cx = x + dx, cy = y + dy;
      if (cx < 0 || cy < 0 || cx >= part.size.x || cy >= part.size.y) continue;
      const uint32_t texel = part.texelAt[static_cast<size_t>(cy * part.size.x + cx)];
      if (texel == TexelSet::kNone) continue;
      const int far = dx * dx + dy * dy;
      const bool isBuried = texels.isBuried(texel);
      const bool isBetter =
          best == TexelSet::kNone || (isBuried != bestIsBuried ? bestIsBuried : far < bestFar);
      if (!isBetter) continue;
      best = texel;
      bestFar = far;
      bestIsBuried = isBuried;
    }
  }
  return best;
}

}  // namespace

FieldSurface::FieldSurface(const RenderScene& scene, std::span<const ObjectAtlas> atlases,
                           const TexelSet& texels, bool withLamps)
    : sides_(2 * scene.objects.size()) {
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    const RenderObject& object = scene.objects[o];
    if (object.isEmpty() || (object.isAreaLight && !withLamps)) continue;
    if (object.isAreaLight) {
      addLamp(scene, o);
      continue;
    }
    const Material& material = scene.materials[static_cast<size_t>(object.material)];
    if (material.isClear()) continue;
    const ObjectAtlas* own = o < atlases.size() && atlases[o].atlas ? &atlases[o] : nullptr;
    for (uint32_t t = 0; t < object.triangleCount(); ++t) {
      const uint32_t* i = &scene.indices[object.firstIndex + 3 * t];
      Triangle& out = triangles_.emplace_back();
      out.object = o;
      out.triangle = t;
      out.isMasked = material.alphaMode == AlphaMode::mask;
      out.hasTexels = own != nullptr && own->atlas->chartOfTriangle[t] >= 0;
      corners_.push_back({i[0], i[1], i[2]});
      for (size_t k = 0; out.hasTexels && k < 3; ++k)
        out.texels[k] = own->texelsOf(t, scene.positions[i[k]]);
    }
  }
  tbb::parallel_for(size_t{0}, texels.parts().size(), [&](size_t s) {
    const TexelSet::Part& part = texels.parts()[s];
    if (part.count == 0) return;
    Side& side = sides_[s];
    side.size = part.size;
    side.nearest.resize(part.texelAt.size());
    for (int y = 0; y < side.size.y; ++y) {
      for (int x = 0; x < side.size.x; ++x) {
        const auto at = static_cast<size_t>(y * side.size.x + x);
        const uint32_t texel = part.texelAt[at];
        const bool isOpen = texel != kNone && !texels.isBuried(texel);
        side.nearest[at] = isOpen ? texel : nearestTexel(texels, part, x, y);
      }
    }
  });
}

// The front of an area light.
void FieldSurface::addLamp(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    const uint32_t* i = &scene.indices[o.firstIndex + 3 * t];
    Triangle& out = triangles_.emplace_back();
    out.object = object;
    out.triangle = t;
    out.hasTexels = true;
    corners_.push_back({i[0], i[1], i[2]});
    for (size_t k = 0; k < 3; ++k) out.texels[k] = static_cast<float>(kLampSide) * scene.uv0[i[k]];
  }
  Side& front = sides_[2 * object];
  front.size = glm::ivec2(kLampSide);
  const uint32_t first = kLamps + static_cast<uint32_t>(kLampPlaces * lamps_.size());
  for (uint32_t k = 0; k < kLampPlaces; ++k) front.nearest.push_back(first + k);
  lamps_.push_back(object);
}

uint32_t FieldSurface::texelAt(uint32_t object, bool isBack, const vec2& texels) const {
  const Side& side = sides_[2 * object + (isBack ? 1 : 0)];
  if (side.nearest.empty()) return kNone;
  const vec2 most = vec2(side.size) - 1.0f;
  const vec2 at = glm::clamp(texels, vec2(0.0f), most);
  return side
      .nearest[static_cast<size_t>(static_cast<int>(at.y) * side.size.x + static_cast<int>(at.x))];
}

uint32_t FieldSurface::texelAt(const RenderScene& scene, std::span<const ObjectAtlas> atlases,
                               const Ray& ray, const Hit& hit) const {
  if (scene.objects[hit.object].isAreaLight) {
    const uint32_t* i = &scene.indices[scene.objects[hit.object].firstIndex + 3 * hit.triangle];
    const vec2 uv = (1.0f - hit.u - hit.v) * scene.uv0[i[0]] + hit.u * scene.uv0[i[1]] +
                    hit.v * scene.uv0[i[2]];
    return texelAt(hit.object, isOnBack(scene, hit, ray.direction),
                   static_cast<float>(kLampSide) * uv);
  }
  const ObjectAtlas& own = atlases[hit.object];
  if (!own.atlas || own.atlas->chartOfTriangle[hit.triangle] < 0) return kNone;
  return texelAt(hit.object, isOnBack(scene, hit, ray.direction),
                 own.texelsOf(hit.triangle, ray.origin + hit.t * ray.direction));
}

size_t FieldSurface::bytes() const {
  size_t bytes = triangles_.size() * (sizeof(Triangle) + sizeof(Corners));
  for (const Side& side : sides_) bytes += side.nearest.size() * sizeof(uint32_t);
  return bytes;
}

}  // namespace lamplighter
