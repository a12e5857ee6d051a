#include "renderer/surface_light/direct_meshes/visible_triangles.h"

#include <algorithm>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

constexpr uint64_t kNothing = ~uint64_t{0};

struct Seen {
  uint64_t key = kNothing;  // object, triangle, side
  VisibleTriangles::Pixel pixel;
};

}  // namespace

VisibleTriangles::VisibleTriangles(const RenderScene& scene, const GBufferView& gbuffer) {
  const int width = gbuffer.width(), height = gbuffer.height();
  std::vector<Seen> seen(static_cast<size_t>(width) * static_cast<size_t>(height));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const SeenTriangle at(scene, p);
      if (!at.isSound) continue;
      const auto index = static_cast<uint32_t>(y * width + x);
      seen[index] = {uint64_t{p.object} << 32 | uint64_t{p.triangle} << 1 | (at.isBack ? 1u : 0u),
                     {index, vec3(1.0f - at.weights.x - at.weights.y, at.weights)}};
    }
  });
  tbb::parallel_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
    return a.key != b.key ? a.key < b.key : a.pixel.index < b.pixel.index;
  });
  uint64_t last = kNothing;
  for (const Seen& s : seen) {
    if (s.key == kNothing) break;
    if (s.key != last)
      triangles_.push_back({static_cast<uint32_t>(s.key >> 32),
                            static_cast<uint32_t>(s.key & 0xffffffffu) >> 1, (s.key & 1u) != 0,
                            static_cast<uint32_t>(pixels_.size()), 0});
    last = s.key;
    ++triangles_.back().count;
    pixels_.push_back(s.pixel);
  }
}

}  // namespace lamplighter
