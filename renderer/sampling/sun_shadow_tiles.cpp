#include "renderer/sampling/sun_shadow_tiles.h"

#include <algorithm>
#include <cmath>

#include "renderer/sampling/view_points.h"

namespace lamplighter {
namespace {

constexpr float kLeastSide = 0.25f;  // metres; finer shadows do not justify a map
constexpr uint32_t kLastCode =
    1u << 28;  // largest code of a tile that may be divided; the codes of its quarters fit, too
// Number of visible points to test. Points in shadow have a lower weight than lit ones: shadow
// borders are among lit points, but a coarse map may leak light into the shadow.
constexpr int kSeenPoints = 1024;
constexpr float kInShadow = 0.25f;
// Weight of visible points; the remainder is for places to which the camera may turn.
constexpr float kSeenShare = 0.8f;

// The area that an object covers in the plane perpendicular to the sun's direction.
struct Footprint {
  vec2 min, max;
  float weight;  // √triangles: detail counts, but a mesh of a million triangles does not equal a
                 // thousand boxes

  float shareWithin(const SunShadowTile& s) const {
    const vec2 low = glm::max(min, s.centre - s.side), high = glm::min(max, s.centre + s.side);
    if (low.x >= high.x || low.y >= high.y) return 0.0f;
    return (high.x - low.x) * (high.y - low.y) / ((max.x - min.x) * (max.y - min.y));
  }
};

Footprint footprintOf(const RenderObject& object, const mat3& axes, const vec3& middle) {
  // Half-size of the box along the axes.
  const vec3 half = 0.5f * object.bounds.extent();
  const vec3 from = object.bounds.centre() - middle;
  const vec2 at(glm::dot(from, axes[0]), glm::dot(from, axes[1]));
  const float thin = 1e-4f * (1.0f + object.bounds.radius());  // gives a flat object a non-zero
                                                               // area
  const vec2 reach(glm::dot(glm::abs(axes[0]), half) + thin,
                   glm::dot(glm::abs(axes[1]), half) + thin);
  return {at - reach, at + reach, std::sqrt(static_cast<float>(object.triangleCount()))};
}

// The gain of halving the texel size of a tile.
class Gain {
 public:
  Gain(const RenderScene& scene, const mat3& axes, const vec3& middle,
       std::span<const SunPoint> points)
      : points_(points) {
    footprints_.reserve(scene.objects.size());
    for (const RenderObject& o : scene.objects) footprints_.push_back(footprintOf(o, axes, middle));
    float objects = 0.0f, seen = 0.0f;
    for (const Footprint& f : footprints_) objects += f.weight;
    for (const SunPoint& p : points) seen += p.weight;
    const float seenShare = seen > 0.0f ? kSeenShare : 0.0f;
    ofObjects_ = objects > 0.0f ? (1.0f - seenShare) / objects : 0.0f;
    ofPoints_ = seen > 0.0f ? seenShare / seen : 0.0f;
  }

  float of(const SunShadowTile& s) const {
    float objects = 0.0f, seen = 0.0f;
    for (const Footprint& f : footprints_) objects += f.weight * f.shareWithin(s);
    for (const SunPoint& p : points_) {
      const vec2 from = glm::abs(p.at - s.centre);
      if (std::max(from.x, from.y) <= s.side) seen += p.weight;
    }
    return (ofObjects_ * objects + ofPoints_ * seen) * s.side;
  }

 private:
  std::vector<Footprint> footprints_;
  std::span<const SunPoint> points_;
  float ofObjects_ = 0.0f, ofPoints_ = 0.0f;
};

std::vector<SunPoint> pointsOf(std::span<const SeenPoint> seen, const mat3& axes,
                               const vec3& middle, const RayCaster& rays) {
  std::vector<SunPoint> points;
  for (const SeenPoint& p : seen) {
    if (glm::dot(p.normal, axes[2]) <= 0.0f) continue;
    const vec3 from = p.position - middle;
    points.push_back({vec2(glm::dot(from, axes[0]), glm::dot(from, axes[1])),
                      rays.occluded({p.position, 0.0f, axes[2]}) ? kInShadow : 1.0f});
  }
  return points;
}

}  // namespace

std::vector<SunShadowTile> sunShadowTiles(const RenderScene& scene, const mat3& axes,
                                          const vec3& middle, float whole, int count,
                                          std::span<const SunPoint> points) {
  const Gain gain(scene, axes, middle, points);
  struct Leaf {
    SunShadowTile square;
    float gain;
  };
  const auto isLast = [](const SunShadowTile& s) {
    return 0.5f * s.side < kLeastSide || s.code >= kLastCode;
  };
  const SunShadowTile all{vec2(0.0f), whole, 1};
  std::vector<Leaf> leaves{{all, isLast(all) ? 0.0f : gain.of(all)}};
  while (static_cast<int>(leaves.size()) + 3 <= count) {
    const auto best = std::max_element(
        leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.gain < b.gain; });
    if (!(best->gain > 0.0f)) break;
    const SunShadowTile s = best->square;
    const float half = 0.5f * s.side;
    leaves.erase(best);
    for (uint32_t quarter = 0; quarter < 4; ++quarter) {
      const vec2 corner((quarter & 1u) != 0 ? half : -half, (quarter & 2u) != 0 ? half : -half);
      const SunShadowTile part{s.centre + corner, half, 4 * s.code + quarter};
      const float more = gain.of(part);
      if (more > 0.0f) leaves.push_back({part, isLast(part) ? 0.0f : more});
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return a.square.code < b.square.code; });
  std::vector<SunShadowTile> squares;
  for (const Leaf& leaf : leaves) squares.push_back(leaf.square);
  return squares;
}

void divideSuns(std::vector<SceneVpl>& vpls, const RenderScene& scene, const RayCaster& rays,
                const View* view, int count) {
  if (std::none_of(vpls.begin(), vpls.end(), [](const SceneVpl& v) { return v.isOfSun(); })) return;
  std::vector<SeenPoint> seen;
  if (view != nullptr) seen = seenPoints(scene, rays, *view, kSeenPoints);
  std::vector<SceneVpl> divided;
  divided.reserve(vpls.size());
  for (const SceneVpl& v : vpls) {
    if (!v.isOfSun()) {
      divided.push_back(v);
      continue;
    }
    const vec3 tangent(v.vpl.tangent), towards(v.vpl.normal), middle(v.vpl.position);
    const mat3 axes(tangent, glm::cross(towards, tangent), towards);
    const std::vector<SunPoint> points = pointsOf(seen, axes, middle, rays);
    for (const SunShadowTile& s :
         sunShadowTiles(scene, axes, middle, v.vpl.tangent.w, count, std::span(points))) {
      SceneVpl& part = divided.emplace_back(v);
      part.id.index = s.code;
      part.vpl.position += vec4(axes * vec3(s.centre, 0.0f), 0.0f);
      part.vpl.tangent.w = s.side;
    }
  }
  vpls = std::move(divided);
}

}  // namespace lamplighter
