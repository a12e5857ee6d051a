#include "renderer/patches/triangle_bounds.h"

#include "renderer/base/simd.h"

namespace lamplighter {

Bounds boundsOf(const RenderScene& scene, const RenderObject& object,
                std::span<const uint32_t> triangles) {
  Bounds box;
  const hn::FixedTag<float, 4> tag;
  const auto three = hn::FirstN(tag, 3);
  const auto load = [&](const vec3& v) { return hn::MaskedLoad(three, tag, &v.x); };
  auto least = load(box.min), most = load(box.max);
  for (const uint32_t t : triangles) {
    const uint32_t* corners = &scene.indices[object.firstIndex + 3 * t];
    for (size_t c = 0; c < 3; ++c) {
      const auto p = load(scene.positions[corners[c]]);
      least = hn::Min(p, least);
      most = hn::Max(p, most);
    }
  }
  hn::BlendedStore(least, three, tag, &box.min.x);
  hn::BlendedStore(most, three, tag, &box.max.x);
  return box;
}

}  // namespace lamplighter
