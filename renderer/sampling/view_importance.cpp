#include "renderer/sampling/view_importance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/base/simd.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Number of visible points; with many candidates fewer are used, to limit the number of rays.
constexpr int kMostPoints = PointVisibility::kMostPoints, kFewestPoints = 32;
constexpr size_t kMostRays = size_t{1} << 19;
// How far beyond the picture's edges points may be, as a fraction of its size.
constexpr float kMargin = 0.1f;
// Fraction of the choice that ignores importance. VPLs that no point sees may still light the space
// between the points. It also limits the scaling of any VPL to 1/kEvenShare times.
constexpr float kEvenShare = 0.25f;
// Points darker than this fraction of the mean get the weight of this brightness.
constexpr double kDarkest = 0.01;
constexpr float kEyeGrid = 0.5f;  // metres
constexpr float kTurnGrid = 15.0f * kPi / 180.0f;
constexpr int kSteadyHeight = 1024;  // makes the result depend only on the aspect ratio of the
                                     // picture
constexpr uint32_t kPointSet = 0x5d, kRankSet = 0x6d;

constexpr hn::FixedTag<double, 4> kDoubles;
constexpr hn::FixedTag<float, 4> kFloats;

// One column per point.
constexpr size_t kColumns = PointVisibility::kMostPoints;
using Columns = std::array<double, kColumns>;

hn::Vec<decltype(kDoubles)> loadDoubles(const float* row) {
  return hn::PromoteTo(kDoubles, hn::LoadU(kFloats, row));
}
void addTo(Columns& sums, const float* row) {
  for (size_t j = 0; j < kColumns; j += 4)
    hn::StoreU(hn::Add(hn::LoadU(kDoubles, &sums[j]), loadDoubles(row + j)), kDoubles, &sums[j]);
}
// Squared ratio of each row element to the sum of its column.
void squareShares(const float* row, const Columns& whole, Columns& out) {
  for (size_t j = 0; j < kColumns; j += 4) {
    const auto share = hn::Div(loadDoubles(row + j), hn::LoadU(kDoubles, &whole[j]));
    hn::StoreU(hn::Mul(share, share), kDoubles, &out[j]);
  }
}

bool isCandidate(const SceneVpl& v) {
  return v.id.bounce > 0 || (v.isSample && v.vpl.position.w == shared::kVplDirectional);
}

}  // namespace

std::vector<SeenPoint> seenPoints(const RenderScene& scene, const RayCaster& rays, const View& view,
                                  int count) {
  std::vector<SeenPoint> points;
  points.reserve(static_cast<size_t>(count));
  const vec2 size(view.width, view.height);
  for (int i = 0; i < count; ++i) {
    const vec2 u = sobol2(static_cast<uint32_t>(i), kPointSet);
    const vec2 at = ((1.0f + 2.0f * kMargin) * u - kMargin) * size;
    const vec3 direction = view.rayDirection(at.x, at.y);
    const float tNear = view.znear / glm::dot(direction, view.forward());
    const Hit hit = rays.intersect({view.eye, tNear, direction}, Surfaces::seen);
    if (!hit) continue;
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    const float side = glm::dot(direction, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
    const vec3 normal = side * s.geometricNormal;
    points.push_back({s.position + rayEpsilon(s.position) * normal, normal,
                      scene.objects[hit.object].leftOutBy});
  }
  return points;
}

View steadyView(const View& view, const RayCaster& rays) {
  const auto onGrid = [](float value, float step) { return std::round(value / step) * step; };
  View steady = view;
  steady.height = kSteadyHeight;
  steady.width = static_cast<int>(std::lround(view.aspect() * static_cast<float>(kSteadyHeight)));
  const vec3 forward = view.forward();
  const float pitch = onGrid(std::asin(std::clamp(forward.y, -1.0f, 1.0f)), kTurnGrid);
  const float yaw = onGrid(std::atan2(-forward.x, -forward.z), kTurnGrid);
  steady.orientation = glm::angleAxis(yaw, vec3(0, 1, 0)) * glm::angleAxis(pitch, vec3(1, 0, 0));
  const vec3 eye(onGrid(view.eye.x, kEyeGrid), onGrid(view.eye.y, kEyeGrid),
                 onGrid(view.eye.z, kEyeGrid));
  const float way = glm::length(eye - view.eye);
  // Tests slightly further than the grid point, so that the eye is not inside a wall that it
  // touches.
  if (way > 0.0f && !rays.occluded({view.eye, 0.0f, (eye - view.eye) / way, way + 0.1f}))
    steady.eye = eye;
  return steady;
}

std::vector<float> importanceOf(std::span<const SceneVpl> candidates,
                                std::span<const SceneVpl> others, std::span<const SeenPoint> points,
                                const RayCaster& rays, float clampDistance, PointVisibility& kept) {
  std::vector<float> importance(candidates.size(), 0.0f);
  if (points.empty() || candidates.empty()) return importance;
  std::vector<SceneVpl> lights(candidates.begin(), candidates.end());
  lights.insert(lights.end(), others.begin(), others.end());
  const std::span<const float> irradiance = kept.irradiance(lights, points, rays, clampDistance);
  const auto row = [&](size_t light) { return &irradiance[light * kColumns]; };
  Columns sums{};
  for (size_t i = 0; i < lights.size(); ++i) addTo(sums, row(i));
  const auto count = static_cast<double>(points.size());
  const double mean =
      std::accumulate(sums.begin(), sums.begin() + static_cast<ptrdiff_t>(points.size()), 0.0) /
      count;
  if (!(mean > 0.0)) return importance;
  Columns whole;
  for (size_t j = 0; j < kColumns; ++j) whole[j] = std::max(sums[j], kDarkest * mean);
  // Sums four rows at a time, to hide the latency of additions.
  constexpr size_t kAtOnce = 4;
  tbb::parallel_for(size_t{0}, (candidates.size() + kAtOnce - 1) / kAtOnce, [&](size_t group) {
    const size_t first = group * kAtOnce, last = candidates.size() - 1;
    std::array<Columns, kAtOnce> squares;
    for (size_t i = 0; i < kAtOnce; ++i)
      squareShares(row(std::min(first + i, last)), whole, squares[i]);
    std::array<double, kAtOnce> sum{};
    for (size_t j = 0; j < kColumns; ++j)
      for (size_t i = 0; i < kAtOnce; ++i) sum[i] += squares[i][j];
    for (size_t i = 0; i < kAtOnce && first + i <= last; ++i)
      importance[first + i] = static_cast<float>(std::sqrt(sum[i] / count));
  });
  return importance;
}

std::vector<SceneVpl> chooseByImportance(std::span<const SceneVpl> candidates,
                                         std::span<const float> importance, int count) {
  const size_t wanted = static_cast<size_t>(std::max(count, 0));
  if (candidates.size() <= wanted) return {candidates.begin(), candidates.end()};
  if (wanted == 0) return {};
  // Number of points of each sequence.
  std::map<VplId, uint32_t> lengths;
  const auto sequence = [](const VplId& id) {
    return VplId{id.light, id.emitter, id.bounce > 0 ? 1u : 0u, 0};
  };
  for (const SceneVpl& c : candidates) {
    uint32_t& length = lengths[sequence(c.id)];
    length = std::max(length, c.id.index + 1);
  }
  const float sum = std::accumulate(importance.begin(), importance.end(), 0.0f);
  const float scale =
      sum > 0.0f ? (1.0f - kEvenShare) * static_cast<float>(candidates.size()) / sum : 0.0f;
  // share: fraction of the candidates to take at each position, up to a common factor; taken: the
  // factor at which each candidate is taken.
  std::vector<float> share(candidates.size()), taken(candidates.size());
  for (size_t i = 0; i < candidates.size(); ++i) {
    const VplId of = sequence(candidates[i].id);
    // An offset per sequence, so that sequences do not end at the same factor; otherwise the VPLs
    // of many small sequences would appear and disappear together.
    const float offset = toUnitFloat(hash4(of.light, of.emitter, of.bounce, kRankSet));
    const float rank =
        (static_cast<float>(candidates[i].id.index) + offset) / static_cast<float>(lengths[of]);
    share[i] = std::exp2(std::round(std::log2(kEvenShare + scale * importance[i])));
    taken[i] = rank / share[i];
  }
  std::vector<size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return taken[a] != taken[b] ? taken[a] < taken[b] : a < b; });
  const float factor = 0.5f * (taken[order[wanted - 1]] + taken[order[wanted]]);
  order.resize(wanted);
  std::sort(order.begin(), order.end());
  std::vector<SceneVpl> chosen;
  chosen.reserve(wanted);
  for (const size_t i : order) {
    SceneVpl& c = chosen.emplace_back(candidates[i]);
    const float probability = std::min(1.0f, share[i] * factor);
    c.vpl.intensity /= probability;
  }
  return chosen;
}

VplSet chooseForView(const VplSet& set, const VplCounts& counts, const RenderScene& scene,
                     const RayCaster& rays, const View& view, float clampDistance,
                     PointVisibility& kept) {
  if (counts.candidates <= 1) return set;
  std::vector<SceneVpl> candidates;
  VplSet chosen;
  chosen.rays = set.rays;
  chosen.paths = set.paths;
  chosen.pathIds = set.pathIds;
  int sky = 0;
  for (const SceneVpl& v : set.vpls) {
    (isCandidate(v) ? candidates : chosen.vpls).push_back(v);
    sky += isCandidate(v) && v.id.bounce == 0;
  }
  // Samples that direct light does not need are used for indirect light.
  const int wanted = counts.bounces > 0 ? counts.total - static_cast<int>(chosen.vpls.size())
                                        : sky / counts.candidates;
  const size_t mostPoints = kMostRays / std::max<size_t>(set.vpls.size(), 1);
  const std::vector<SeenPoint> points = seenPoints(
      scene, rays, view, std::clamp(static_cast<int>(mostPoints), kFewestPoints, kMostPoints));
  const std::vector<float> importance =
      importanceOf(candidates, chosen.vpls, points, rays, clampDistance, kept);
  for (SceneVpl& v : chooseByImportance(candidates, importance, wanted))
    chosen.vpls.push_back(std::move(v));
  return chosen;
}

}  // namespace lamplighter
