#include "renderer/probes/probe_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

constexpr size_t kRays = 64;
// A place is inside if back hits are a larger share of its hits than this.
constexpr size_t kInsideShare = 4;  // as one in this number
constexpr int kSteps = 6;
// Directions are up to 0.3 rad from the nearest ray: a plane at the distance of the padding is met
// at up to this factor of it.
constexpr float kMargin = 1.05f;
// Maximum displacement of a place from its node along each axis, as a share of the spacing.
constexpr float kReach = 0.5f;
constexpr size_t kMostWallsOfNode = 3;  // around a place
constexpr float kAlike = 0.7f;          // normals whose cosine is larger are those of one wall
// A side of a surface belongs to the level if the share of its rays that hit nothing is smaller by
// more than this than on the other side.
constexpr float kLessOpen = 0.1f;
// Hits whose distances differ by less than this share of the distance count as one surface.
constexpr float kSamePlace = 1e-4f;
constexpr float kGrowth = 1.1f;  // growth of the spacing until the limit is met
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

// The hits of the rays from a place.
struct Surroundings {
  size_t fronts = 0, backs = 0;
  size_t turned = 0;  // back faces of all surfaces, also of double-sided ones
  float nearestFront = std::numeric_limits<float>::infinity();
  float nearestBack = std::numeric_limits<float>::infinity();
  // Surfaces nearer than the padding, the nearest one first: normal on the side of the place,
  // distances of the plane and of the hit.
  struct Plane {
    vec3 away{0.0f};
    float distance = 0.0f, hit = 0.0f;
    bool isBack = false;
  };
  std::vector<Plane> planes;
  vec3 towardsBack{0.0f};  // direction of the nearest back

  float behind() const { return static_cast<float>(turned) / kRays; }
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

  const Bounds& level() const { return scene_.bounds; }
  // Rays start slightly before the place, so that they hit a surface on which it lies.
  Surroundings around(const vec3& place, float padding) const {
    const float before = std::max(rayEpsilon(place), 0.01f * padding);
    Surroundings found;
    for (size_t first = 0; first < kRays; first += 8) {
      std::array<Ray, 8> group;
      std::array<Hit, 8> hits;
      for (size_t i = 0; i < 8; ++i)
        group[i] = {place - before * directions_[first + i], 0.0f, directions_[first + i]};
      rays_.leastHits8(group, hits);
      for (size_t i = 0; i < 8; ++i)
        if (hits[i]) add(group[i], hits[i], std::max(hits[i].t - before, 0.0f), padding, found);
    }
    std::ranges::stable_sort(found.planes, {}, &Surroundings::Plane::hit);
    return found;
  }

 private:
  // `distance`: from the place.
  void add(const Ray& ray, const Hit& hit, float distance, float padding,
           Surroundings& found) const {
    found.turned += isOnBack(scene_, hit, ray.direction);
    const bool isBack = isUnseenBack(ray, hit);
    ++(isBack ? found.backs : found.fronts);
    if (isBack && distance < found.nearestBack) found.towardsBack = ray.direction;
    float& nearest = isBack ? found.nearestBack : found.nearestFront;
    nearest = std::min(distance, nearest);
    if (distance >= kMargin * padding) return;
    const vec3 n = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v).geometricNormal;
    const float cosine = glm::dot(n, ray.direction);
    found.planes.push_back({cosine > 0.0f ? -n : n, distance * std::abs(cosine), distance, isBack});
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

class Placement {
 public:
  Placement(const Surveyor& surveyor, const ProbeGrid& grid, const glm::ivec3& node, float padding)
      : surveyor_(surveyor),
        home_(grid.placeOf(node)),
        reach_(kReach * grid.spacing),
        padding_(padding) {}

  Probe place() const {
    const Surroundings here = surveyor_.around(home_, padding_);
    const ProbeState state = here.state(padding_);
    if (isBeside(home_)) {
      const vec3 in = inLevel();
      const auto found =
          isInReach(in) ? walk(in, surveyor_.around(in, padding_)) : std::optional<Probe>();
      return found ? *found : probeAt(home_, ProbeState::outside, here);
    }
    if (state == ProbeState::valid || state == ProbeState::outside)
      return probeAt(home_, state, here);
    std::optional<Probe> found = besideWalls(here);
    if (!found) found = walk(home_, here);
    return found ? *found : probeAt(home_, state, here);
  }

 private:
  static Probe probeAt(const vec3& place, ProbeState state, const Surroundings& there) {
    return {place, state, there.open(), there.behind()};
  }
  // Slightly more than the padding, because of rounding.
  float wanted() const { return 1.01f * kMargin * padding_; }
  // Objects may move above the level, but not beside or below it.
  bool isBeside(const vec3& place) const {
    const Bounds& level = surveyor_.level();
    const vec3 low = place - level.min, high = level.max - place;
    return std::min({low.x, low.y, low.z, high.x, high.z}) < -1e-3f * reach_;
  }
  // The nearest place that is as far from the bounds of the level as probes are from surfaces.
  vec3 inLevel() const {
    const Bounds& level = surveyor_.level();
    const vec3 inset = glm::min(vec3(wanted()), 0.5f * level.extent());
    vec3 place = glm::clamp(home_, level.min + inset, level.max - inset);
    if (home_.y > place.y) place.y = home_.y;
    return place;
  }
  bool isInReach(const vec3& place) const {
    const vec3 moved = glm::abs(place - home_);
    return std::max({moved.x, moved.y, moved.z}) <= reach_;
  }

  // Tries all combinations of sides of up to three near surfaces that meet at an angle, as in a
  // corner, own sides first. Another one is used if more of the level is visible from it.
  std::optional<Probe> besideWalls(const Surroundings& here) const {
    std::vector<Surroundings::Plane> walls;
    for (const Surroundings::Plane& plane : here.planes)
      if (walls.size() < kMostWallsOfNode && std::ranges::none_of(walls, [&](const auto& wall) {
            return std::abs(glm::dot(wall.away, plane.away)) > kAlike;
          }))
        walls.push_back(plane);
    std::optional<Probe> best;
    for (uint32_t sides = 0; sides < 1u << walls.size(); ++sides) {
      vec3 place = home_;
      for (size_t i = 0; i < walls.size(); ++i)
        place += (sides >> i & 1u) != 0
                     ? -(walls[i].distance + wanted()) * walls[i].away
                     : std::max(wanted() - walls[i].distance, 0.0f) * walls[i].away;
      if (!isInReach(place)) continue;
      const auto found = walk(place, surveyor_.around(place, padding_));
      if (found && (!best || found->open < best->open - kLessOpen)) best = found;
    }
    return best;
  }

  std::optional<Probe> walk(vec3 place, Surroundings found) const {
    for (int step = 0; step <= kSteps; ++step) {
      const ProbeState state = found.state(padding_);
      if (state == ProbeState::valid && isBeside(place)) break;
      if (state == ProbeState::valid) return probeAt(place, state, found);
      if (state == ProbeState::outside || (state == ProbeState::inside && found.backs == 0)) break;
      if (state == ProbeState::inside) {
        place += (found.nearestBack + wanted()) * found.towardsBack;
      } else {
        const auto& front = *std::ranges::find(found.planes, false, &Surroundings::Plane::isBack);
        place += std::max(wanted() - front.distance, 0.02f * padding_) * front.away;
      }
      if (!isInReach(place)) break;
      found = surveyor_.around(place, padding_);
    }
    return std::nullopt;
  }

  const Surveyor& surveyor_;
  vec3 home_;
  float reach_, padding_;
};

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
    // Those beyond have no place in the bounds.
    const vec3 low = glm::ceil(bounds.min / grid.spacing - kReach);
    const vec3 high = glm::floor(bounds.max / grid.spacing + kReach);
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
  return Placement(Surveyor(scene, rays), grid, node, padding).place();
}

ProbeGrid placeProbes(const RenderScene& scene, const RayCaster& rays,
                      const ProbeGridOptions& options) {
  ProbeGrid grid = probeNodes(scene.bounds, options);
  const Surveyor surveyor(scene, rays);
  tbb::parallel_for(size_t{0}, grid.probes.size(), [&](size_t i) {
    grid.probes[i] = Placement(surveyor, grid, grid.nodeAt(i), options.padding).place();
  });
  return grid;
}

}  // namespace lamplighter
