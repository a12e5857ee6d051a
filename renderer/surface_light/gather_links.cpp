#include "renderer/surface_light/gather_links.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kGatherSet = 0x6a;
// A sample is buried if more than one in this number of its rays hit such a back face.
constexpr std::ptrdiff_t kBuriedShare = 8;

// Morton code: the bits of x and y in turn.
uint32_t interleaved(uint32_t x, uint32_t y) {
  uint32_t out = 0;
  for (uint32_t bit = 0; bit < 16; ++bit)
    out |= (x >> bit & 1u) << (2 * bit) | (y >> bit & 1u) << (2 * bit + 1);
  return out;
}

}  // namespace

float GatherLink::metres() const { return std::bit_cast<float>(uint32_t{distance} << 16); }

vec3 projectedDirection(const vec2& point, GatherProjection projection) {
  constexpr float kTangentOf80 = 5.6712818f;
  const vec3 d = sampleCosineHemisphere(point);
  const bool isSeen = projection == GatherProjection::hemisphere ||
                      std::max(std::abs(d.x), std::abs(d.y)) < kTangentOf80 * d.z;
  return isSeen ? d : vec3(0.0f);
}

std::vector<vec3> gatherDirections(int count, uint32_t scramble, GatherProjection projection) {
  std::vector<vec2> points;
  for (int i = 0; i < count; ++i) points.push_back(sobol2(static_cast<uint32_t>(i), scramble));
  std::ranges::stable_sort(points, {}, [](const vec2& p) {
    return interleaved(static_cast<uint32_t>(p.x * 65536.0f),
                       static_cast<uint32_t>(p.y * 65536.0f));
  });
  // Order: each 16th, then each 4th of the others, then the rest. Starts at a random one, so that
  // the first ones are not all on one side.
  const size_t first = hash4(scramble, 1, 0, kGatherSet);
  std::vector<vec3> directions;
  for (size_t step = 16; step > 0; step /= 4)
    for (size_t i = 0; i < points.size(); ++i)
      if (i % step == first % step && (step == 16 || i % (4 * step) != first % (4 * step)))
        directions.push_back(projectedDirection(points[i], projection));
  return directions;
}

Frame gatherFrame(const SurfaceSpot& spot) {
  Frame frame(spot.normal);
  // A random rotation, without trigonometric functions, which may differ between processors: by up
  // to 45° (t: tangent of half of it), then by a multiple of 90°.
  constexpr float kMostTangent = 0.41421356f;
  const float t = kMostTangent * (static_cast<float>(spot.turn >> 8) / 8388608.0f - 1.0f);
  float c = (1.0f - t * t) / (1.0f + t * t), s = 2.0f * t / (1.0f + t * t);
  if ((spot.turn & 1u) != 0) c = std::exchange(s, -c);
  if ((spot.turn & 2u) != 0) {
    c = -c;
    s = -s;
  }
  const vec3 tangent = frame.tangent;
  frame.tangent = c * tangent + s * frame.bitangent;
  frame.bitangent = c * frame.bitangent - s * tangent;
  return frame;
}

vec3 gatherDirection(const SurfaceSpot& spot, const vec3& direction) {
  const vec3 world = gatherFrame(spot).toWorld(direction);
  return glm::dot(world, spot.geometricNormal) > 0.0f ? world : vec3(0.0f);
}

size_t GatherLinks::raysOfStage(int stage) const {
  const size_t step = size_t{1} << 2 * (kStages - stage);
  return (rays_ + step - 1) / step;
}

void GatherLinks::restart(const SurfaceMesh& mesh, int rays, uint32_t seed,
                          GatherProjection projection) {
  *this = {};
  rays_ = static_cast<size_t>(rays);
  words_ = (rays_ + 63) / 64;
  for (uint32_t set = 0; set < kDirectionSets; ++set)
    for (const vec3& d : gatherDirections(rays, hash4(seed, set, 0, kGatherSet), projection))
      directions_.push_back(d);
  std::vector<uint32_t> all(mesh.objects());
  std::iota(all.begin(), all.end(), 0u);
  renew(mesh, all);
}

void GatherLinks::renew(const SurfaceMesh& mesh, std::span<const uint32_t> objects) {
  const size_t samples = mesh.samples();
  sets_.resize(samples);
  known_.resize(samples);
  staleCounts_.resize(samples);
  stale_.resize(samples * words_);
  links_.resize(samples * rays_);
  for (uint32_t s = 0; s < samples; ++s) {
    if (mesh.objectOfSample(s) != SurfaceMesh::kUnused) continue;
    known_[s] = staleCounts_[s] = 0;
  }
  for (const uint32_t o : objects) {
    const SurfaceMesh::Part& part = mesh.part(o);
    if (!part.shape) continue;
    for (uint32_t local = 0; local < part.shape->samples.size(); ++local) {
      const uint32_t s = part.firstSample + local;
      sets_[s] = static_cast<uint8_t>(hash4(local, 0, 0, kGatherSet) % kDirectionSets);
      known_[s] = staleCounts_[s] = 0;
      std::ranges::fill(staleOf(s), 0u);
    }
  }
  staleSamples_ = static_cast<size_t>(
      std::ranges::count_if(staleCounts_, [](uint16_t count) { return count > 0; }));
  stage_ = 0;
}

uint64_t GatherLinks::raysLeft() const {
  uint64_t left = 0;
  for (size_t s = 0; s < known_.size(); ++s)
    if (known_[s] > 0) left += staleCounts_[s] + rays_ - known_[s];
  return left;
}

bool GatherLinks::isBuried(uint32_t sample, float within) const {
  const auto links = of(sample);
  return kBuriedShare * std::ranges::count_if(links,
                                              [&](const GatherLink& link) {
                                                return link.leaf == GatherLink::kInside &&
                                                       link.metres() < within;
                                              }) >
         static_cast<std::ptrdiff_t>(links.size());
}

float GatherLinks::reachOf(uint32_t sample) const {
  float sum = 0.0f;
  for (const GatherLink& link : of(sample)) sum += 1.0f / std::max(link.metres(), 1e-6f);
  return static_cast<float>(known_[sample]) / std::max(sum, 1e-6f);
}

}  // namespace lamplighter
