#include "renderer/sampling/sun_squares.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

constexpr float kLeastSide = 0.25f;  // metres; finer shadows are not worth a map

// What an object covers of the plane across the sun's direction.
struct Footprint {
  vec2 min, max;
  float weight;  // √triangles: detail counts, but a mesh of a million is not a thousand boxes

  float shareWithin(const SunSquare& s) const {
    const vec2 low = glm::max(min, s.centre - s.side), high = glm::min(max, s.centre + s.side);
    if (low.x >= high.x || low.y >= high.y) return 0.0f;
    return (high.x - low.x) * (high.y - low.y) / ((max.x - min.x) * (max.y - min.y));
  }
};

Footprint footprintOf(const RenderObject& object, const mat3& axes, const vec3& middle) {
  // Half extents of the box along the axes.
  const vec3 half = 0.5f * object.bounds.extent();
  const vec3 from = object.bounds.centre() - middle;
  const vec2 at(glm::dot(from, axes[0]), glm::dot(from, axes[1]));
  const float thin = 1e-4f * (1.0f + object.bounds.radius());  // gives a flat one an area
  const vec2 reach(glm::dot(glm::abs(axes[0]), half) + thin,
                   glm::dot(glm::abs(axes[1]), half) + thin);
  return {at - reach, at + reach, std::sqrt(static_cast<float>(object.triangleCount()))};
}

}  // namespace

std::vector<SunSquare> sunSquares(const RenderScene& scene, const mat3& axes, const vec3& middle,
                                  float whole, int count) {
  std::vector<Footprint> footprints;
  footprints.reserve(scene.objects.size());
  for (const RenderObject& o : scene.objects) footprints.push_back(footprintOf(o, axes, middle));
  const auto gain = [&](const SunSquare& s) {
    float sum = 0.0f;
    for (const Footprint& f : footprints) sum += f.weight * f.shareWithin(s);
    return sum * s.side;
  };

  struct Leaf {
    SunSquare square;
    float gain;
  };
  std::vector<Leaf> leaves{{{vec2(0.0f), whole, 1}, 0.0f}};
  leaves[0].gain = gain(leaves[0].square);
  while (static_cast<int>(leaves.size()) + 3 <= count) {
    const auto best = std::max_element(
        leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.gain < b.gain; });
    const SunSquare s = best->square;
    const float half = 0.5f * s.side;
    if (!(best->gain > 0.0f) || half < kLeastSide) break;
    leaves.erase(best);
    for (uint32_t quarter = 0; quarter < 4; ++quarter) {
      const vec2 corner((quarter & 1u) != 0 ? half : -half, (quarter & 2u) != 0 ? half : -half);
      const SunSquare part{s.centre + corner, half, 4 * s.code + quarter};
      const float partGain = gain(part);
      if (partGain > 0.0f) leaves.push_back({part, partGain});
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return a.square.code < b.square.code; });
  std::vector<SunSquare> squares;
  for (const Leaf& leaf : leaves) squares.push_back(leaf.square);
  return squares;
}

}  // namespace lamplighter
