#include "renderer/probes/probe_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

constexpr size_t kRays = 64;
// Larger shares of the hits are those of a place inside.
constexpr size_t kInsideShare = 4;  // one in so many
constexpr int kSteps = 6;
// Directions are up to 0.3 rad from the nearest ray: a plane at the distance of the padding is met
// at up to this factor of it.
constexpr float kMargin = 1.05f;
// Of the spacing: moved places stay so near to their node along each axis.
constexpr float kReach = 0.5f;
// Surfaces that are so near to each other, relative to their distance, are in the same place.
constexpr float kSamePlace = 1e-4f;
constexpr float kGrowth = 1.1f;  // of the spacing, until the bound is kept
// Multiples of the spacing beyond this are not exact in a float.
constexpr float kFurthestNode = 1e6f;

// Directions spread evenly over the sphere (a Fibonacci lattice).
std::array<vec3, kRays> evenDirections() {
  std::array<vec3, kRays> out;
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  for (size_t i = 0; i < kRays; ++i) {
    const double y = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / kRays;
    const double r = std::sqrt(1.0 - y * y);
    const double turns = static_cast<double>(i) / golden;
    const double angle = 2.0 * 3.14159265358979323846 * (turns - std::floor(turns));
    out[i] = vec3(static_cast<float>(r * std::cos(angle)), static_cast<float>(y),
                  static_cast<float>(r * std::sin(angle)));
  }
  return out;
}

// What the rays from a place meet.
struct Surroundings {
  size_t fronts = 0, backs = 0;
  float nearestFront = std::numeric_limits<float>::infinity();
  float nearestBack = std::numeric_limits<float>::infinity();
  vec3 away{0.0f};     // the normal of the nearest front, on the side of the place
  float plane = 0.0f;  // distance of its plane
  vec3 behind{0.0f};   // direction of the nearest back

  float open() const { return 1.0f - static_cast<float>(fronts + backs) / kRays; }
  ProbeState state(float padding) const {
    if (fronts == 0 && kInsideShare * backs <= kRays) return ProbeState::outside;
    if (kInsideShare * backs > fronts + backs) return ProbeState::inside;
    const float least = kMargin * padding;
    if (nearestBack < least && nearestBack < nearestFront) return ProbeState::inside;
    return nearestFront < least ? ProbeState::near : ProbeState::valid;
  }
};

class Surveyor {
 public:
  Surveyor(const RenderScene& scene, const RayCaster& rays)
      : scene_(scene), rays_(rays), directions_(evenDirections()) {}

  Surroundings around(const vec3& place) const {
    Surroundings found;
    for (size_t first = 0; first < kRays; first += 8) {
      std::array<Ray, 8> group;
      std::array<Hit, 8> hits;
      for (size_t i = 0; i < 8; ++i) group[i] = {place, 0.0f, directions_[first + i]};
      rays_.leastHits8(group, hits);
      for (size_t i = 0; i < 8; ++i)
        if (hits[i]) add(group[i], hits[i], found);
    }
    return found;
  }

 private:
  void add(const Ray& ray, const Hit& hit, Surroundings& found) const {
    if (isUnseenBack(ray, hit)) {
      ++found.backs;
      if (hit.t >= found.nearestBack) return;
      found.nearestBack = hit.t;
      found.behind = ray.direction;
      return;
    }
    ++found.fronts;
    if (hit.t >= found.nearestFront) return;
    found.nearestFront = hit.t;
    const vec3 n = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v).geometricNormal;
    const float cosine = glm::dot(n, ray.direction);
    found.away = cosine > 0.0f ? -n : n;
    found.plane = hit.t * std::abs(cosine);
  }

  bool isUnseenBack(const Ray& ray, const Hit& hit) const {
    if (!scene_.backIsUnseen(hit.object) || !isOnBack(scene_, hit, ray.direction)) return false;
    const Hit seen = rays_.intersect(ray, Surfaces::seen);
    return !seen || seen.t > (1.0f + kSamePlace) * hit.t;
  }

  const RenderScene& scene_;
  const RayCaster& rays_;
  std::array<vec3, kRays> directions_;
};

Probe placed(const Surveyor& surveyor, const ProbeGrid& grid, const glm::ivec3& node,
             float padding) {
  const vec3 home = grid.placeOf(node);
  Probe probe{home, ProbeState::outside, 1.0f};
  const float reach = kReach * grid.spacing;
  // A little more, so that rounding does not undo it.
  const float wanted = 1.01f * kMargin * padding;
  vec3 place = home;
  for (int step = 0; step <= kSteps; ++step) {
    const Surroundings found = surveyor.around(place);
    const ProbeState state = found.state(padding);
    if (step == 0) probe.state = state, probe.open = found.open();
    if (state == ProbeState::valid) return {place, state, found.open()};
    if (state == ProbeState::outside) break;
    if (state == ProbeState::inside) {
      if (found.backs == 0) break;
      place += (found.nearestBack + wanted) * found.behind;
    } else {
      place += std::max(wanted - found.plane, 0.02f * padding) * found.away;
    }
    const vec3 moved = glm::abs(place - home);
    if (std::max({moved.x, moved.y, moved.z}) > reach) break;
  }
  return probe;
}

}  // namespace

glm::ivec3 ProbeGrid::nodeAt(size_t index) const {
  const auto x = static_cast<size_t>(size.x), y = static_cast<size_t>(size.y);
  return {static_cast<int>(index % x), static_cast<int>(index / x % y),
          static_cast<int>(index / (x * y))};
}

size_t ProbeGrid::count(ProbeState state) const {
  return static_cast<size_t>(
      std::ranges::count_if(probes, [&](const Probe& p) { return p.state == state; }));
}

ProbeGrid probeNodes(const Bounds& bounds, const ProbeGridOptions& options) {
  ProbeGrid grid;
  grid.spacing = options.spacing;
  if (bounds.empty()) return grid;
  for (;; grid.spacing *= kGrowth, grid.isCoarser = true) {
    // Bounds on a node within rounding need no node beyond it.
    const vec3 low = glm::floor(bounds.min / grid.spacing + 1e-3f);
    const vec3 high = glm::ceil(bounds.max / grid.spacing - 1e-3f);
    const vec3 furthest = glm::max(glm::abs(low), glm::abs(high));
    if (std::max({furthest.x, furthest.y, furthest.z}) > kFurthestNode) continue;
    const vec3 size = glm::max(high - low, vec3(0.0f)) + 1.0f;
    if (static_cast<double>(size.x) * size.y * size.z > static_cast<double>(options.most) &&
        (size.x > 1.0f || size.y > 1.0f || size.z > 1.0f))
      continue;
    grid.first = glm::ivec3(low);
    grid.size = glm::ivec3(size);
    break;
  }
  grid.probes.resize(static_cast<size_t>(grid.size.x) * static_cast<size_t>(grid.size.y) *
                     static_cast<size_t>(grid.size.z));
  for (size_t i = 0; i < grid.probes.size(); ++i)
    grid.probes[i].position = grid.placeOf(grid.nodeAt(i));
  return grid;
}

Probe placedProbe(const RenderScene& scene, const RayCaster& rays, const ProbeGrid& grid,
                  const glm::ivec3& node, float padding) {
  return placed(Surveyor(scene, rays), grid, node, padding);
}

ProbeGrid placeProbes(const RenderScene& scene, const RayCaster& rays,
                      const ProbeGridOptions& options) {
  ProbeGrid grid = probeNodes(scene.bounds, options);
  const Surveyor surveyor(scene, rays);
  tbb::parallel_for(size_t{0}, grid.probes.size(), [&](size_t i) {
    grid.probes[i] = placed(surveyor, grid, grid.nodeAt(i), options.padding);
  });
  return grid;
}

}  // namespace lamplighter
