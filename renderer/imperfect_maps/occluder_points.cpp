#include "renderer/imperfect_maps/occluder_points.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/base/error.h"
#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/emitters/emitter_cells.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

constexpr uint32_t kFineSet = 0x0cc2;
constexpr uint32_t kPointsAStep = 512;
constexpr uint32_t kSmallestMap = 64;  // an eighth is a whole vector

void checkPointOptions(const OccluderPointOptions& options) {
  const uint32_t map = options.pointsPerMap;
  if (!std::has_single_bit(map) || map < kSmallestMap)
    throw InputError("occluder points", "a map of " + std::to_string(map) + " points",
                     "use a power of two from 64 on");
  if (options.points == 0 || options.points % map != 0)
    throw InputError("occluder points", std::to_string(options.points) + " points in all",
                     "use a multiple of the points of a map");
}

// Whether the alpha mask lets rays pass there.
bool isInHole(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v) {
  const Material& m = scene.materials[static_cast<size_t>(scene.objects[object].material)];
  return m.alphaMode == AlphaMode::mask && alphaAt(scene, object, triangle, u, v) < m.alphaCutoff;
}

struct PlaceInGroup {
  uint32_t triangle = 0;
  float within = 0.0f;  // the part of its area before the place, in [0, 1)
};

// Where the sum of the areas is `area`. Triangles without area are never chosen. Rounding may give
// the very end: then it is the end of the last one.
PlaceInGroup placeIn(std::span<const OccluderTriangle> triangles, float area) {
  const OccluderTriangle* chosen = triangles.data();
  float start = 0.0f, before = 0.0f;
  for (const OccluderTriangle& t : triangles) {
    if (t.areaUpTo > before) {
      chosen = &t;
      start = before;
    }
    before = t.areaUpTo;
    if (before > area) break;
  }
  const float within = (area - start) / (chosen->areaUpTo - start);
  return {chosen->triangle, std::clamp(within, 0.0f, 0x1.fffffep-1f)};
}

}  // namespace

bool OccluderPoints::update(const RenderScene& scene, const RenderSceneChanges& changes,
                            std::span<const vec3> viewPositions,
                            std::span<const vec3> lightPositions,
                            const OccluderPointOptions& options) {
  checkPointOptions(options);
  RenderSceneChanges everything;
  everything.rebuilt = true;
  const RenderSceneChanges& since = isStarted_ ? changes : everything;
  const bool isFresh = since.rebuilt || options != options_;
  isStarted_ = false;  // if anything throws
  options_ = options;
  const bool hasOtherSurfaces = groups_.update(scene, since);
  const bool hasOtherPositions = takePositions(viewPositions, lightPositions);
  if (isFresh) {
    OccluderPointArrays& a = arrays_;
    for (LaneFloats* list : {&a.px, &a.py, &a.pz, &a.nx, &a.ny, &a.nz, &a.area})
      list->assign(options.points, 0.0f);
    for (std::vector<float>* list : {&a.u, &a.v}) list->assign(options.points, 0.0f);
    for (std::vector<uint32_t>* list : {&a.object, &a.triangle}) list->assign(options.points, 0);
    next_ = 0;
  } else if (hasOtherSurfaces) {
    follow(scene, since);
  }
  // A material may have another alpha mask.
  if (isFresh || hasOtherSurfaces || hasOtherPositions || since.materials) {
    importance_.update(scene, groups_, viewPositions_, lightPositions_, options.importance);
    isCurrent_.fill(false);
    objectAreas_.resize(groups_.objects());
    for (uint32_t i = 0; i < objectAreas_.size(); ++i) objectAreas_[i] = groups_.areaOf(i);
  }
  for (uint32_t& age : ages_) ++age;
  const bool draws = !isSettled();
  for (uint32_t drawn = 0; !isSettled() && (isFresh || drawn == 0); ++drawn) {
    drawEighth(scene, next_);
    isCurrent_[next_] = true;
    ages_[next_] = 0;
    next_ = (next_ + 1) % kEighths;
  }
  isStarted_ = true;
  return draws;
}

uint32_t OccluderPoints::pendingFrames() const {
  return static_cast<uint32_t>(std::count(isCurrent_.begin(), isCurrent_.end(), false));
}

bool OccluderPoints::takePositions(std::span<const vec3> view, std::span<const vec3> lights) {
  const bool differs =
      !std::ranges::equal(view, viewPositions_) || !std::ranges::equal(lights, lightPositions_);
  if (differs) {
    viewPositions_.assign(view.begin(), view.end());
    lightPositions_.assign(lights.begin(), lights.end());
  }
  return differs;
}

// Points keep their barycentric position in their triangle. After an object was scaled, they
// represent more or less area, in proportion to that of the object, until they are drawn again.
void OccluderPoints::follow(const RenderScene& scene, const RenderSceneChanges& changes) {
  std::vector<uint8_t> isMoved(groups_.objects(), 0);
  for (const uint32_t object : changes.movedObjects) isMoved[object] = 1;
  std::vector<float> growth(groups_.objects(), 1.0f);
  for (uint32_t i = 0; i < growth.size(); ++i) {
    const double before = i < objectAreas_.size() ? objectAreas_[i] : 0.0;
    const double after = groups_.areaOf(i);
    if (after != before) growth[i] = before > 0.0 ? static_cast<float>(after / before) : 0.0f;
  }
  const uint32_t count = size();
  tbb::parallel_for(uint32_t{0}, (count + kPointsAStep - 1) / kPointsAStep, [&](uint32_t step) {
    const uint32_t end = std::min((step + 1) * kPointsAStep, count);
    for (uint32_t j = step * kPointsAStep; j < end; ++j) {
      const uint32_t object = arrays_.object[j];
      float& area = arrays_.area[j];
      area *= growth[object];
      if (isMoved[object] == 0 || !(area > 0.0f)) continue;
      // The surface of an area light may have fewer triangles than before.
      if (arrays_.triangle[j] < scene.objects[object].triangleCount()) {
        place(scene, j);
      } else {
        area = 0.0f;
      }
    }
  });
}

// Points lie in the order of the distribution: points that are near each other in memory are near
// each other in space. Of the 2ᵏ points of a part, exactly one has its first coordinate in each
// 2⁻ᵏ.
void OccluderPoints::drawEighth(const RenderScene& scene, uint32_t eighth) {
  const uint32_t part = options_.pointsPerMap / kEighths;
  tbb::parallel_for(uint32_t{0}, options_.points / options_.pointsPerMap, [&](uint32_t map) {
    const uint32_t first = map * options_.pointsPerMap + eighth * part;
    std::vector<Draw> draws(part);
    for (uint32_t j = first; j < first + part; ++j) {
      const vec2 random = sobol2Ordered(j, options_.importance.seed);
      draws[static_cast<uint32_t>(random.x * static_cast<float>(part))] = {j, random};
    }
    for (uint32_t i = 0; i < part; i += kPointsAStep)
      draw(scene, first + i, std::span(draws).subspan(i, std::min(kPointsAStep, part - i)));
  });
}

// Step by step for all points, so that the waits for memory of different points overlap.
void OccluderPoints::draw(const RenderScene& scene, uint32_t first, std::span<const Draw> draws) {
  const auto count = static_cast<uint32_t>(draws.size());
  if (importance_.empty()) {
    std::fill_n(arrays_.area.begin() + first, count, 0.0f);
    return;
  }
  const uint32_t seed = options_.importance.seed;
  const auto perMap = static_cast<double>(options_.pointsPerMap);
  std::array<OccluderImportance::Choice, kPointsAStep> choices;
  for (uint32_t i = 0; i < count; ++i) {
    // The 24 bits of a float are too few for both the choice of a group among many and a place in
    // it. Random bits below them keep the strata.
    const double fine =
        0x1p-24 * static_cast<double>(toUnitFloat(hash4(draws[i].index, seed, kFineSet, 0)));
    choices[i] = importance_.at(static_cast<double>(draws[i].random.x) + fine);
  }
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t j = first + i;
    const OccluderGroup& group = groups_.groups()[choices[i].group];
    const auto area = static_cast<double>(group.area);
    arrays_.object[j] = group.object;
    arrays_.area[j] =
        static_cast<float>(area / (importance_.probability(choices[i].group) * perMap));
    const PlaceInGroup at =
        placeIn(groups_.trianglesOf(group), static_cast<float>(choices[i].within * area));
    arrays_.triangle[j] = at.triangle;
    const vec2 weights = sampleTriangle({at.within, draws[i].random.y});
    arrays_.u[j] = weights.x;
    arrays_.v[j] = weights.y;
  }
  for (uint32_t j = first; j < first + count; ++j) {
    place(scene, j);
    if (isInHole(scene, arrays_.object[j], arrays_.triangle[j], arrays_.u[j], arrays_.v[j]))
      arrays_.area[j] = 0.0f;
  }
}

void OccluderPoints::place(const RenderScene& scene, uint32_t point) {
  const uint32_t* corner = &scene.indices[scene.objects[arrays_.object[point]].firstIndex +
                                          size_t{3} * arrays_.triangle[point]];
  const vec3& a = scene.positions[corner[0]];
  const vec3 toB = scene.positions[corner[1]] - a, toC = scene.positions[corner[2]] - a;
  const vec3 at = a + arrays_.u[point] * toB + arrays_.v[point] * toC;
  const vec3 cross = glm::cross(toB, toC);
  const float length = glm::length(cross);
  const vec3 n = length > 0.0f ? cross / length : vec3(0.0f, 0.0f, 1.0f);
  arrays_.px[point] = at.x;
  arrays_.py[point] = at.y;
  arrays_.pz[point] = at.z;
  arrays_.nx[point] = n.x;
  arrays_.ny[point] = n.y;
  arrays_.nz[point] = n.z;
}

size_t OccluderPoints::poolBytes() const {
  const OccluderPointArrays& a = arrays_;
  const size_t floats = a.px.capacity() + a.py.capacity() + a.pz.capacity() + a.nx.capacity() +
                        a.ny.capacity() + a.nz.capacity() + a.area.capacity() + a.u.capacity() +
                        a.v.capacity();
  return floats * sizeof(float) + (a.object.capacity() + a.triangle.capacity()) * sizeof(uint32_t);
}

size_t OccluderPoints::memoryBytes() const {
  return poolBytes() + groups_.memoryBytes() + importance_.memoryBytes() +
         (viewPositions_.capacity() + lightPositions_.capacity()) * sizeof(vec3) +
         objectAreas_.capacity() * sizeof(double);
}

}  // namespace lamplighter
