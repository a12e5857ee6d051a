#include "renderer/sampling/choice/view_importance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/base/simd.h"
#include "renderer/sampling/choice/unshadowed_importance.h"
#include "renderer/sampling/sample_streams.h"
#include "renderer/sampling/vpl_counts.h"

namespace lamplighter {
namespace {

// Number of visible points; with many candidates fewer are used, to limit the number of rays.
constexpr int kMostPoints = PointVisibility::kMostPoints, kFewestPoints = 32;
constexpr size_t kMostRays = size_t{1} << 19;
// Rays test this many times the wanted number. In front of them, more candidates are compared
// without shadows, at the points that this number of values allows.
constexpr size_t kTestedShare = 3;
constexpr size_t kMostUnshadowed = size_t{1} << 22;
// Fraction of the choice that ignores importance. VPLs that no point sees may still light the space
// between the points.
constexpr float kEvenShare = 1.0f / kLargestWeight;
constexpr float kRootOfHalf = 0.70710678f;
// Points darker than this fraction of the mean get the weight of this brightness.
constexpr double kDarkest = 0.01;
constexpr uint32_t kRankSet = 0x6d;

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

namespace {

// The position of each candidate in its sequence, in [0, 1).
std::vector<float> ranksOf(std::span<const SceneVpl> candidates) {
  const auto sequence = [](const VplId& id) {
    return VplId{id.light, id.emitter, id.bounce > 0 ? 1u : 0u, 0};
  };
  // Number of points of each sequence, and an offset, so that sequences do not end at the same
  // factor; otherwise the VPLs of many small sequences would appear and disappear together.
  struct Sequence {
    uint32_t length = 0;
    float offset = 0.0f;
  };
  std::map<VplId, Sequence> sequences;
  std::vector<const Sequence*> of(candidates.size());
  std::pair<const VplId, Sequence>* last = nullptr;  // most candidates follow one of theirs
  for (size_t i = 0; i < candidates.size(); ++i) {
    const VplId id = sequence(candidates[i].id);
    if (last == nullptr || last->first != id) {
      last = &*sequences.try_emplace(id).first;
      last->second.offset = toUnitFloat(hash4(id.light, id.emitter, id.bounce, kRankSet));
    }
    last->second.length = std::max(last->second.length, candidates[i].id.index + 1);
    of[i] = &last->second;
  }
  std::vector<float> ranks(candidates.size());
  for (size_t i = 0; i < ranks.size(); ++i)
    ranks[i] = (static_cast<float>(candidates[i].id.index) + of[i]->offset) /
               static_cast<float>(of[i]->length);
  return ranks;
}

// The remaining candidates. A candidate that is taken if rank < probability has a rank that is
// uniform in [0, probability) afterwards, so rank / probability decides in the next choice. Both
// choices together are one with the product of the probabilities, still by the first points.
struct Remaining {
  explicit Remaining(std::vector<SceneVpl> all)
      : vpls(std::move(all)), ranks(ranksOf(vpls)), replaced(vpls.size(), 1.0f) {}

  std::vector<SceneVpl> vpls;  // each with the flux of those that it replaces
  std::vector<float> ranks;
  std::vector<float> replaced;  // the number of candidates that each represents
};

// Keeps `wanted` of them, in their order.
void choose(Remaining& left, std::span<const float> importance, size_t wanted) {
  const size_t count = left.vpls.size();
  if (count <= wanted) return;
  if (wanted == 0) {
    left = Remaining({});
    return;
  }
  const float sum = std::accumulate(importance.begin(), importance.end(), 0.0f);
  const float all = std::accumulate(left.replaced.begin(), left.replaced.end(), 0.0f);
  const float scale = sum > 0.0f ? (1.0f - kEvenShare) * all / sum : 0.0f;
  // share: fraction of the candidates to take at each position, up to a common factor; taken: the
  // factor at which each candidate is taken. What is rounded is the share of what each replaces, so
  // that the product of the probabilities of all choices is. It is rounded down: the shares of all
  // candidates sum up to no more than their number, so that no weight exceeds kLargestWeight.
  std::vector<float> share(count), taken(count);
  for (size_t i = 0; i < count; ++i) {
    const float wished = kEvenShare + scale * importance[i] / left.replaced[i];
    share[i] = left.replaced[i] * std::max(kEvenShare, kRootOfHalf * nearestPowerOfTwo(wished));
    taken[i] = left.ranks[i] / share[i];
  }
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  std::nth_element(
      order.begin(), order.begin() + static_cast<ptrdiff_t>(wanted), order.end(),
      [&](size_t a, size_t b) { return taken[a] != taken[b] ? taken[a] < taken[b] : a < b; });
  const float next = taken[order[wanted]];
  order.resize(wanted);
  std::sort(order.begin(), order.end());
  float last = 0.0f;
  for (const size_t i : order) last = std::max(last, taken[i]);
  const float factor = 0.5f * (last + next);
  for (size_t to = 0; to < wanted; ++to) {
    const size_t from = order[to];
    const float probability = std::min(1.0f, share[from] * factor);
    if (to != from) left.vpls[to] = std::move(left.vpls[from]);
    left.vpls[to].vpl.intensity /= probability;
    left.ranks[to] = left.ranks[from] / probability;
    left.replaced[to] = left.replaced[from] / probability;
  }
  left.vpls.resize(wanted);
  left.ranks.resize(wanted);
  left.replaced.resize(wanted);
}

}  // namespace

std::vector<SceneVpl> chooseByImportance(std::span<const SceneVpl> candidates,
                                         std::span<const float> importance, int count) {
  Remaining left({candidates.begin(), candidates.end()});
  choose(left, importance, static_cast<size_t>(std::max(count, 0)));
  return std::move(left.vpls);
}

VplSet chooseForView(const VplSet& set, const VplCounts& counts, const RenderScene& scene,
                     const RayCaster& rays, const View& view, float clampDistance,
                     PointVisibility& visibility) {
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
  const size_t kept = static_cast<size_t>(std::max(wanted, 0));
  Remaining left(std::move(candidates));
  const auto fewer = [](size_t most) {
    return std::clamp(static_cast<int>(most), kFewestPoints, kMostPoints);
  };
  const size_t tested = std::min(left.vpls.size(), kTestedShare * kept);
  const int points = fewer(kMostRays / std::max<size_t>(tested + chosen.vpls.size(), 1));
  const std::vector<SeenPoint> seen = seenPoints(scene, rays, view, points);
  if (tested < left.vpls.size()) {
    const auto cheap = static_cast<size_t>(fewer(kMostUnshadowed / left.vpls.size()));
    const std::span<const SeenPoint> some(seen.data(), std::min(cheap, seen.size()));
    choose(left, unshadowedImportance(left.vpls, some, clampDistance), tested);
  }
  choose(left, importanceOf(left.vpls, chosen.vpls, seen, rays, clampDistance, visibility), kept);
  const SampleStreams numbers(counts);
  for (SceneVpl& v : left.vpls) {
    if (v.id.bounce > 0)
      v.vpl.tangent = vec4(numbers.turnedTangent(v.id, vec3(v.vpl.normal)), v.vpl.tangent.w);
    chosen.vpls.push_back(std::move(v));
  }
  return chosen;
}

}  // namespace lamplighter
