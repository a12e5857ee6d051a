#include "renderer/surface_depths/surface_depths.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/byte_stream.h"

namespace lamplighter {
namespace {

// Number of pixels per unit of work.
constexpr uint32_t kBlock = 64;
// Maximum number of surfaces that are searched for one that faces the texel.
constexpr int kMostSurfaces = 6;
// Directions of pixels that are partly above the surface are raised to this sine of the angle to
// it.
constexpr float kLeastSine = 0.02f;

// The direction in which a texel looks through a pixel; 0 if the pixel is below its surface.
vec3 lookThrough(const DepthMapLayout& layout, const SurfaceTexel& texel, uint32_t pixel) {
  const vec3 d = layout.directionOf(pixel);
  const float sine = glm::dot(d, texel.spot.geometricNormal);
  if (sine >= kLeastSine) return d;
  if (sine < -layout.halfWidth()) return vec3(0.0f);
  return glm::normalize(d + (kLeastSine - sine) * texel.spot.geometricNormal);
}

// Whether light from the texel may fall on the surface.
bool faces(const RenderScene& scene, const Hit& hit, const vec3& direction) {
  const RenderObject& o = scene.objects[hit.object];
  return scene.materials[static_cast<size_t>(o.material)].doubleSided ||
         !isOnBack(scene, hit, direction);
}

uint16_t rounded(float steps) {
  return static_cast<uint16_t>(std::clamp(std::ceil(steps), 0.0f, 65534.0f));
}

}  // namespace

size_t SurfaceDepths::blocks() const { return (layout_.pixels() + kBlock - 1) / kBlock; }

void SurfaceDepths::restart(const RenderScene& scene, const TexelSet& texels,
                            const DepthMapLayout& layout) {
  *this = {};
  layout_ = layout;
  texels_ = texels.size();
  steps_ = 65534.0f / std::max(2.0f * scene.bounds.radius(), 1e-6f);
  runOf_.resize(texels.size());
  for (const TexelSet::Part& part : texels.parts()) {
    for (uint32_t k = 0; k < part.count; k += kMostInRun) {
      const uint32_t count = std::min(part.count - k, static_cast<uint32_t>(kMostInRun));
      for (uint32_t i = 0; i < count; ++i)
        runOf_[part.first + k + i] = static_cast<uint32_t>(runs_.size());
      runs_.push_back({part.first + k, count, {0}, {}});
    }
  }
}

// Computes the intervals of one pixel for all texels of a run. Returns the number of rays.
uint64_t SurfaceDepths::trace(const RenderScene& scene, const RayCaster& rays,
                              const TexelSet& texels, const Run& run, uint32_t pixel,
                              std::vector<DepthInterval>& out) const {
  uint64_t traced = 0;
  out.assign(run.count, {});
  for (uint32_t begin = 0; begin < run.count; begin += 8) {
    const uint32_t lanes = std::min(run.count - begin, 8u);
    std::array<Ray, 8> ray;
    std::array<bool, 8> isFirst{};
    for (uint32_t k = 0; k < 8; ++k) {
      ray[k].tFar = -1.0f;
      if (k >= lanes) continue;
      const SurfaceTexel& texel = texels[run.first + begin + k];
      const vec3 direction = lookThrough(layout_, texel, pixel);
      if (direction == vec3(0.0f)) continue;
      ray[k] = {texel.spot.rayOrigin(), 0.0f, direction};
      isFirst[k] = true;
    }
    for (int surface = 0; surface < kMostSurfaces; ++surface) {
      std::array<Hit, 8> hits{};
      uint64_t active = 0;
      for (const Ray& r : ray) active += r.tFar > 0.0f ? 1 : 0;
      if (active == 0) break;
      traced += active;
      rays.leastHits8(ray, hits);
      for (uint32_t k = 0; k < lanes; ++k) {
        if (ray[k].tFar < 0.0f) continue;
        DepthInterval& interval = out[begin + k];
        const Hit& hit = hits[k];
        // Area lights do not block bounced light, so that they can move freely.
        const bool isLight = hit && scene.objects[hit.object].isAreaLight;
        if (isFirst[k] && !isLight)
          interval =
              hit ? DepthInterval{rounded(hit.t * steps_), kOpen - 1} : DepthInterval{kOpen, kOpen};
        const bool isSecond = !isFirst[k] && hit && !isLight && faces(scene, hit, ray[k].direction);
        if (isSecond) {
          const int before = static_cast<int>(rounded(hit.t * steps_)) - 2;
          interval.most = static_cast<uint16_t>(std::max(before, static_cast<int>(interval.least)));
        }
        isFirst[k] = isFirst[k] && isLight;
        if (!hit || isSecond)
          ray[k].tFar = -1.0f;
        else
          ray[k].tNear = hit.t + rayEpsilon(ray[k].origin + hit.t * ray[k].direction);
      }
    }
  }
  return traced;
}

uint64_t SurfaceDepths::goOn(const RenderScene& scene, const RayCaster& rays,
                             const TexelSet& texels, uint64_t most) {
  // About two rays for each pixel that is above the surface: one in two.
  const uint64_t raysOfUnit = kBlock * std::min<uint64_t>(kMostInRun, texels_);
  const size_t count = std::min(
      units() - nextUnit_,
      static_cast<size_t>(std::max<uint64_t>(1, most / std::max<uint64_t>(raysOfUnit, 1))));
  struct Part {
    std::vector<uint32_t> counts;  // of segments, by pixel
    DepthSegments segments;
  };
  std::vector<Part> parts(count);
  std::atomic<uint64_t> traced = 0;
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    const size_t unit = nextUnit_ + i;
    const Run& run = runs_[unit / blocks()];
    const auto first = static_cast<uint32_t>(unit % blocks()) * kBlock;
    const uint32_t end = std::min(first + kBlock, layout_.pixels());
    std::vector<DepthInterval> intervals;
    uint64_t own = 0;
    for (uint32_t pixel = first; pixel < end; ++pixel) {
      own += trace(scene, rays, texels, run, pixel, intervals);
      const size_t before = parts[i].segments.values.size();
      compress(intervals, parts[i].segments);
      parts[i].counts.push_back(static_cast<uint32_t>(parts[i].segments.values.size() - before));
    }
    traced += own;
  });
  for (size_t i = 0; i < count; ++i) {
    Run& run = runs_[(nextUnit_ + i) / blocks()];
    for (const uint32_t n : parts[i].counts) run.starts.push_back(run.starts.back() + n);
    const DepthSegments& s = parts[i].segments;
    run.segments.values.insert(run.segments.values.end(), s.values.begin(), s.values.end());
    run.segments.last.insert(run.segments.last.end(), s.last.begin(), s.last.end());
  }
  nextUnit_ += count;
  return traced;
}

std::vector<uint8_t> SurfaceDepths::saved() const {
  std::vector<uint8_t> bytes;
  for (const Run& run : runs_) {
    append(bytes, run.starts.data(), run.starts.size());
    append(bytes, run.segments.values.data(), run.segments.values.size());
    append(bytes, run.segments.last.data(), run.segments.last.size());
  }
  return bytes;
}

bool SurfaceDepths::restore(std::span<const uint8_t> bytes) {
  const uint32_t pixels = layout_.pixels();
  std::vector<Run> runs = runs_;
  for (Run& run : runs) {
    run.starts.resize(pixels + 1);
    if (!take(bytes, run.starts.data(), run.starts.size()) || run.starts[0] != 0) return false;
    // Each pixel has at least one segment, and at most one per texel.
    for (uint32_t q = 0; q < pixels; ++q)
      if (run.starts[q + 1] <= run.starts[q] || run.starts[q + 1] - run.starts[q] > run.count)
        return false;
    run.segments.values.resize(run.starts.back());
    run.segments.last.resize(run.starts.back());
    if (!take(bytes, run.segments.values.data(), run.segments.values.size()) ||
        !take(bytes, run.segments.last.data(), run.segments.last.size()))
      return false;
    for (uint32_t q = 0; q < pixels; ++q) {
      const auto last =
          std::span(run.segments.last).subspan(run.starts[q], run.starts[q + 1] - run.starts[q]);
      if (!std::ranges::is_sorted(last) || last.back() != run.count - 1) return false;
    }
  }
  if (!bytes.empty()) return false;
  runs_ = std::move(runs);
  nextUnit_ = units();
  return true;
}

float SurfaceDepths::progress() const {
  return units() == 0 ? 1.0f : static_cast<float>(nextUnit_) / static_cast<float>(units());
}

uint16_t SurfaceDepths::valueOf(size_t texel, uint32_t pixel) const {
  const Run& run = runs_[runOf_[texel]];
  const auto k = static_cast<uint8_t>(texel - run.first);
  const auto begin = run.segments.last.begin() + run.starts[pixel];
  const auto end = run.segments.last.begin() + run.starts[pixel + 1];
  return run.segments
      .values[static_cast<size_t>(std::lower_bound(begin, end, k) - run.segments.last.begin())];
}

bool SurfaceDepths::sees(const SurfaceTexel& texel, size_t number, const vec3& point) const {
  const vec3 d = point - texel.spot.rayOrigin();
  if (glm::dot(d, texel.spot.geometricNormal) <= 0.0f) return false;
  const uint16_t value = valueOf(number, layout_.pixelOf(d));
  return value == kOpen || glm::length(d) * steps_ <= static_cast<float>(value) + 0.5f;
}

float SurfaceDepths::segmentShareOf(size_t texel) const {
  const Run& run = runs_[runOf_[texel]];
  return static_cast<float>(run.segments.values.size()) /
         static_cast<float>(run.count * layout_.pixels());
}

size_t SurfaceDepths::segments() const {
  size_t count = 0;
  for (const Run& run : runs_) count += run.segments.values.size();
  return count;
}

size_t SurfaceDepths::bytes() const {
  size_t bytes = runOf_.size() * sizeof(uint32_t);
  for (const Run& run : runs_)
    bytes += run.starts.size() * sizeof(uint32_t) +
             run.segments.values.size() * (sizeof(uint16_t) + sizeof(uint8_t));
  return bytes;
}

}  // namespace lamplighter
