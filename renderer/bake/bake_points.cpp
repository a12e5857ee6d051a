#include "renderer/bake/bake_points.h"

#include <algorithm>
#include <array>

namespace lamplighter {
namespace {

constexpr int kQuarters = 2;  // per side of a texel
// Largest distance from its chart at which a texel still gets a value [quarters].
constexpr float kReach = kQuarters * (kGutter + 1);
// Points on an edge are moved inwards by this fraction of the triangle; otherwise their rays might
// start inside an adjacent wall.
constexpr float kFromEdges = 1e-3f;

struct Nearest {
  float distance = std::numeric_limits<float>::infinity();  // from the quarter's centre [texels]
  uint32_t triangle = 0;
  float u = 0.0f, v = 0.0f;
};

// Barycentric weights of the second and third vertex at the point of the triangle nearest to p.
Nearest nearestOf(const std::array<vec2, 3>& t, const vec2& p, uint32_t triangle) {
  const auto cross = [](const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; };
  const float area = cross(t[1] - t[0], t[2] - t[0]);
  if (area != 0.0f) {
    const float u = cross(p - t[0], t[2] - t[0]) / area, v = cross(t[1] - t[0], p - t[0]) / area;
    if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f) return {0.0f, triangle, u, v};
  }
  Nearest best;
  for (size_t k = 0; k < 3; ++k) {
    const vec2 from = t[k], along = t[(k + 1) % 3] - from;
    const float length2 = glm::dot(along, along);
    const float s =
        length2 > 0.0f ? std::clamp(glm::dot(p - from, along) / length2, 0.0f, 1.0f) : 0.0f;
    const float distance = glm::length(p - from - s * along);
    if (distance >= best.distance) continue;
    const std::array<vec2, 3> weights{vec2(s, 0.0f), vec2(1.0f - s, s), vec2(0.0f, 1.0f - s)};
    best = {distance, triangle, weights[k].x, weights[k].y};
  }
  return best;
}

// The points of one chart that are nearest to each quarter of its texels, including the gutter.
std::vector<Nearest> nearestPoints(const RenderScene& scene, const ObjectChart& placed) {
  const glm::ivec2 size = kQuarters * placed.size;
  std::vector<Nearest> nearest(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
  const RenderObject& o = scene.objects[placed.object];
  constexpr float kScale = kQuarters;
  for (const uint32_t triangle : placed.chart.triangles) {
    std::array<vec2, 3> t;
    for (uint32_t k = 0; k < 3; ++k) {
      const vec3& p = scene.positions[scene.indices[o.firstIndex + 3 * triangle + k]];
      t[k] = kScale * (placed.texelsOf(p) - vec2(placed.at));
    }
    const vec2 low = glm::min(t[0], glm::min(t[1], t[2])) - kReach;
    const vec2 high = glm::max(t[0], glm::max(t[1], t[2])) + kReach;
    const int right = std::min(size.x, static_cast<int>(std::ceil(high.x)));
    const int bottom = std::min(size.y, static_cast<int>(std::ceil(high.y)));
    for (int y = std::max(0, static_cast<int>(low.y)); y < bottom; ++y) {
      for (int x = std::max(0, static_cast<int>(low.x)); x < right; ++x) {
        const Nearest n = nearestOf(t, vec2(x, y) + 0.5f, triangle);
        Nearest& best = nearest[static_cast<size_t>(y * size.x + x)];
        if (n.distance < best.distance && n.distance <= kReach) best = n;
      }
    }
  }
  return nearest;
}

}  // namespace

std::vector<BakePoint> bakePoints(const RenderScene& scene, const LightMapAtlas& atlas, int page) {
  std::vector<BakePoint> points;
  for (const ObjectChart& placed : atlas.charts) {
    if (placed.page != page) continue;
    const std::vector<Nearest> nearest = nearestPoints(scene, placed);
    const int stride = kQuarters * placed.size.x;
    for (int y = 0; y < placed.size.y; ++y) {
      for (int x = 0; x < placed.size.x; ++x) {
        std::array<const Nearest*, kQuarters * kQuarters> quarters;
        for (int k = 0; k < kQuarters * kQuarters; ++k)
          quarters[static_cast<size_t>(k)] = &nearest[static_cast<size_t>(
              (kQuarters * y + k / kQuarters) * stride + kQuarters * x + k % kQuarters)];
        const auto add = [&](const Nearest& n) {
          points.push_back({static_cast<uint16_t>(placed.at.x + x),
                            static_cast<uint16_t>(placed.at.y + y), placed.object, n.triangle,
                            glm::mix(n.u, 1.0f / 3.0f, kFromEdges),
                            glm::mix(n.v, 1.0f / 3.0f, kFromEdges)});
        };
        bool isOn = false;
        for (const Nearest* n : quarters) {
          if (n->distance > 0.0f) continue;
          add(*n);
          isOn = true;
        }
        if (isOn) continue;
        const Nearest& n = **std::min_element(
            quarters.begin(), quarters.end(),
            [](const Nearest* a, const Nearest* b) { return a->distance < b->distance; });
        if (std::isfinite(n.distance)) add(n);
      }
    }
  }
  std::stable_sort(points.begin(), points.end(), [](const BakePoint& a, const BakePoint& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  return points;
}

}  // namespace lamplighter
