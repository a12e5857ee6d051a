#include "renderer/surface_light/pixels/view_records.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/surface_light/gather_rays.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

constexpr uint32_t kRecordSet = 0x7ec;
constexpr std::array<int, 4> kSteps{16, 8, 4, 2};  // pixels between records, by level
constexpr size_t kMostRecords = 65536;
// A record is used within this share of the harmonic mean of its hit distances.
constexpr float kReachShare = 0.35f;
// Decrease of weights with the angle between normals: 0 at 22°.
constexpr float kTurn = 14.0f;
// Factor by which a distance from the plane of the spot counts more than one along it.
constexpr float kOffPlane = 4.0f;
// Pixels with less weight than this get records of their own.
constexpr float kCovered = 0.3f;
constexpr float kLeastWeight = 1e-4f;
constexpr int kSmoothPasses = 4;
// Light is averaged over records within this many radii, and at least over neighbours: records in
// corners have small radii, and few of 64 rays hit a small bright spot.
constexpr float kSmoothRadius = 1.5f;

// Minimum radius of use of a record of the finest level [pixels].
constexpr float kFinestRadius = 24.0f;

// Neighbouring records gather light from different directions; together, 4 × 4 cells cover all
// directions. (Keller and Heidrich, "Interleaved Sampling", 2001)
constexpr uint32_t kSets = 16;
uint8_t setOf(int x, int y) { return static_cast<uint8_t>(x % 4 + 4 * (y % 4)); }

float similarity(const SurfaceSpot& a, const SurfaceSpot& b, float radius) {
  const float turn = 1.0f - kTurn * (1.0f - glm::dot(a.normal, b.normal));
  if (turn <= 0.0f) return 0.0f;
  const vec3 d = b.position - a.position;
  const float off = std::abs(glm::dot(d, b.geometricNormal));
  return turn * std::max(0.0f, 1.0f - (glm::length(d) + kOffPlane * off) / radius);
}

// For spots without a similar record: narrow bevels, leaves. Larger than 0 for normals within 60°.
float likeness(const SurfaceSpot& a, const SurfaceSpot& b, float radius) {
  const vec3 d = (b.position - a.position) / radius;
  return std::max(0.0f, glm::dot(a.normal, b.normal) - 0.5f) / (1.0f + glm::dot(d, d));
}

}  // namespace

void ViewRecords::restart(const View& view, uint32_t seed, GatherProjection projection) {
  *this = {};
  view_ = view;
  for (size_t l = 0; l < kSteps.size(); ++l) {
    const int step = kSteps[l];
    levels_[l] = {step, (view.width + step - 1) / step, (view.height + step - 1) / step, {}};
  }
  // Consecutive points of a Sobol sequence are spread as evenly as all of them.
  for (uint32_t i = 0; i < kSets * kRays; ++i)
    directions_.push_back(projectedDirection(sobol2(i, hash4(seed, 0, 0, kRecordSet)), projection));
}

float ViewRecords::pixelSize(const vec3& position) const {
  return glm::dot(position - view_.eye, view_.forward()) * 2.0f * std::tan(0.5f * view_.yfov) /
         static_cast<float>(view_.height);
}

template <typename Like, typename Take>
void ViewRecords::around(int x, int y, size_t levels, const Like& like, const Take& take) const {
  for (size_t l = 0; l < levels; ++l) {
    const Level& level = levels_[l];
    if (level.records.empty()) continue;
    const auto step = static_cast<float>(level.step);
    const float fx = (static_cast<float>(x) + 0.5f) / step - 0.5f;
    const float fy = (static_cast<float>(y) + 0.5f) / step - 0.5f;
    const int x0 = static_cast<int>(std::floor(fx)), y0 = static_cast<int>(std::floor(fy));
    const float u = fx - static_cast<float>(x0), v = fy - static_cast<float>(y0);
    for (int i = 0; i < 4; ++i) {
      const int cx = x0 + (i & 1), cy = y0 + (i >> 1);
      if (cx < 0 || cy < 0 || cx >= level.width || cy >= level.height) continue;
      const int32_t r = level.records[static_cast<size_t>(cy * level.width + cx)];
      if (r < 0) continue;
      const float tent = ((i & 1) != 0 ? u : 1.0f - u) * ((i >> 1) != 0 ? v : 1.0f - v);
      const Record& record = records_[static_cast<size_t>(r)];
      const float weight = tent * like(record);
      if (weight > 0.0f) take(static_cast<uint32_t>(r), weight);
    }
  }
}

void ViewRecords::outdate(const GatherScene& scene, const SurfaceLight& light) {
  if (light.hasOtherElements()) {
    records_.clear();
    links_.clear();
    values_.clear();
    for (Level& level : levels_) level.records.clear();
    isDone_ = false;
  }
  if (light.movedBoxes().empty()) return;
  isDone_ = false;
  std::vector<bool> isMoved(scene.mesh.objects(), false);
  for (const uint32_t o : light.movedObjects()) isMoved[o] = true;
  tbb::parallel_for(size_t{0}, records_.size(), [&](size_t k) {
    Record& r = records_[k];
    if (isMoved[r.object])
      r.stale = ~uint64_t{0};
    else
      markTouched(scene, r.spot, light.movedBoxes(), directionsOf(r), linksOf(k), 0, 1,
                  {&r.stale, 1});
  });
}

void ViewRecords::retrace(const GatherScene& scene, uint64_t most) {
  std::vector<uint32_t> stale;
  uint64_t planned = 0;
  for (uint32_t r = 0; r < records_.size() && planned < most; ++r) {
    if (records_[r].stale == 0) continue;
    stale.push_back(r);
    planned += static_cast<uint64_t>(std::popcount(records_[r].stale));
  }
  trace(scene, stale);
}

void ViewRecords::choose(const GatherScene& scene, const SurfaceLight& light,
                         const GBufferView& gbuffer, uint64_t most) {
  const std::vector<Record> old = std::exchange(records_, {});
  const std::vector<GatherLink> oldLinks = std::exchange(links_, {});
  std::array<Level, 4> before = levels_;
  for (Level& level : levels_) level.records.clear();
  isDone_ = true;
  uint64_t traced = 0;
  raysLeft_ = 0;
  for (size_t l = 0; l < levels_.size(); ++l) {
    Level& level = levels_[l];
    const auto cells = static_cast<size_t>(level.width) * static_cast<size_t>(level.height);
    std::vector<Record> wanted(cells);
    std::vector<uint8_t> isWanted(cells, 0);
    tbb::parallel_for(size_t{0}, cells, [&](size_t cell) {
      const int x = static_cast<int>(cell) % level.width * level.step + level.step / 2;
      const int y = static_cast<int>(cell) / level.width * level.step + level.step / 2;
      if (x >= gbuffer.width() || y >= gbuffer.height() || !gbuffer.isHit(x, y)) return;
      const GBufferPoint p = gbuffer.at(x, y);
      const SeenTriangle seen(scene.scene, p);
      Record& r = wanted[cell];
      if (!seen.isSound ||
          !scene.mesh.find(scene.scene, p.object, p.triangle, seen.isBack, seen.weights, r.onMesh))
        return;
      r.trust = light.trustAt(r.onMesh);
      if (r.trust >= 1.0f) return;
      r.object = p.object;
      r.place = p.triangle + (seen.isBack ? scene.scene.objects[p.object].triangleCount() : 0);
      r.spot = spotAt(scene.scene, p.object, {r.place, seen.weights.x, seen.weights.y});
      r.level = static_cast<uint8_t>(l);
      r.cell = static_cast<uint32_t>(cell);
      float covered = 0.0f;
      around(
          x, y, l, [&](const Record& o) { return similarity(o.spot, r.spot, o.radius); },
          [&](uint32_t, float weight) { covered += weight; });
      isWanted[cell] = covered < kCovered ? 1 : 0;
    });
    level.records.assign(cells, kNone);
    // If there is no memory for all, some are spread over the picture.
    const auto count = static_cast<size_t>(std::ranges::count(isWanted, uint8_t{1}));
    const size_t room = std::min(count, kMostRecords - records_.size());
    size_t next = 0;
    std::vector<uint32_t> missing;
    for (size_t cell = 0; cell < cells; ++cell) {
      if (!isWanted[cell]) continue;
      const size_t n = next++;
      if (n * room / count == (n + 1) * room / count) continue;
      Record& r = wanted[cell];
      const int32_t was = before[l].records.empty() ? kNone : before[l].records[cell];
      const bool isKnown = was >= 0 && old[static_cast<size_t>(was)].isSame(r);
      r.stale = isKnown ? old[static_cast<size_t>(was)].stale : ~uint64_t{0};
      r.set = setOf(static_cast<int>(cell) % level.width, static_cast<int>(cell) / level.width);
      const bool hasTime = traced < most;
      if (!hasTime && r.stale != 0) {
        isDone_ = false;
        raysLeft_ += kRays;
      }
      if (!hasTime && !isKnown) continue;
      const auto id = static_cast<uint32_t>(records_.size());
      level.records[cell] = static_cast<int32_t>(id);
      links_.resize(links_.size() + kRays);
      if (isKnown) {
        const auto from = oldLinks.begin() + static_cast<std::ptrdiff_t>(was) * kRays;
        std::copy_n(from, kRays, linksOf(id).begin());
        r.radius = old[static_cast<size_t>(was)].radius;
        r.sky = old[static_cast<size_t>(was)].sky;
        r.hasSky = old[static_cast<size_t>(was)].hasSky;
      }
      records_.push_back(r);
      if (r.stale == 0 || !hasTime) continue;
      missing.push_back(id);
      traced += static_cast<uint64_t>(std::popcount(r.stale));
    }
    trace(scene, missing);
  }
  findNear();
}

void ViewRecords::trace(const GatherScene& scene, std::span<const uint32_t> records) {
  tbb::parallel_for(size_t{0}, records.size(), [&](size_t k) {
    Record& r = records_[records[k]];
    const auto links = linksOf(records[k]);
    traceGatherRays(scene, {&r.spot, 1}, directionsOf(r), {&r.stale, 1}, links);
    r.stale = 0;
    r.hasSky = false;
    float sum = 0.0f;
    for (const GatherLink& link : links) sum += 1.0f / std::max(link.metres(), 1e-6f);
    r.radius = kReachShare * static_cast<float>(kRays) / std::max(sum, 1e-6f);
    if (r.level + 1u == kSteps.size())
      r.radius = std::max(r.radius, kFinestRadius * pixelSize(r.spot.position));
  });
}

void ViewRecords::findNear() {
  near_.assign(records_.size(), {});
  tbb::parallel_for(size_t{0}, records_.size(), [&](size_t k) {
    const Record& r = records_[k];
    Near& near = near_[k];
    const Level& level = levels_[r.level];
    const int x = static_cast<int>(r.cell) % level.width,
              y = static_cast<int>(r.cell) / level.width;
    const auto add = [&](const Level& at, int cx, int cy) {
      if (cx < 0 || cy < 0 || cx >= at.width || cy >= at.height) return;
      const int32_t other = at.records[static_cast<size_t>(cy * at.width + cx)];
      if (other < 0 || static_cast<size_t>(other) == k || near.count == near.records.size()) return;
      const Record& o = records_[static_cast<size_t>(other)];
      const float least = static_cast<float>(level.step) * pixelSize(r.spot.position);
      const float radius = std::max(std::min(r.radius, o.radius), least);
      const float weight = similarity(r.spot, o.spot, kSmoothRadius * radius);
      if (weight <= 0.0f) return;
      near.records[near.count] = static_cast<uint32_t>(other);
      near.weights[near.count++] = weight;
    };
    for (int i = 0; i < 9; ++i) add(level, x + i % 3 - 1, y + i / 3 - 1);
    for (size_t l = 0; l < r.level; ++l) {
      const int share = levels_[l].step / level.step;
      for (int i = 0; i < 4; ++i)
        add(levels_[l], (x - share / 2) / share + (i & 1), (y - share / 2) / share + (i >> 1));
    }
  });
}

void ViewRecords::findLight(const RenderScene& scene, const SurfaceLight& light) {
  const auto& reflected = light.reflected();
  values_.assign(records_.size(), vec3(0.0f));
  if (reflected.empty()) return;
  const bool isOtherSky = std::exchange(skyVersion_, light.skyVersion()) != light.skyVersion();
  tbb::parallel_for(size_t{0}, records_.size(), [&](size_t k) {
    Record& r = records_[k];
    if (light.part() != SurfaceLightPart::sky)
      values_[k] = gatheredLight(linksOf(k), reflected) / static_cast<float>(kRays);
    if (light.part() == SurfaceLightPart::bounced) return;
    if (isOtherSky || !r.hasSky)
      r.sky = light.skyAlong(scene, r.object, {&r.spot, 1}, directionsOf(r), linksOf(k));
    r.hasSky = true;
    values_[k] += light.skyBrightness() * r.sky;
  });
  std::vector<vec3> before;
  for (int pass = 0; pass < kSmoothPasses; ++pass) {
    before = values_;
    tbb::parallel_for(size_t{0}, records_.size(), [&](size_t k) {
      const Near& near = near_[k];
      float weights = 1.0f;
      for (size_t i = 0; i < near.count; ++i) {
        values_[k] += near.weights[i] * before[near.records[i]];
        weights += near.weights[i];
      }
      values_[k] /= weights;
    });
  }
  const auto& onMesh = light.values();
  tbb::parallel_for(size_t{0}, records_.size(), [&](size_t k) {
    const Record& r = records_[k];
    vec3 sum(0.0f);
    for (int c = 0; c < 3; ++c)
      sum += r.onMesh.weights[c] * onMesh[r.onMesh.values[static_cast<size_t>(c)]];
    values_[k] = glm::mix(values_[k], sum, r.trust);
  });
}

bool ViewRecords::find(int x, int y, uint32_t object, const SurfaceSpot& spot, Point& out) const {
  // The five with the largest weights. The weight of the fifth is subtracted from the others, so
  // that the light is continuous where another record becomes one of the four.
  std::array<float, 5> weights{};
  std::array<uint32_t, 5> records{};
  const auto take = [&](uint32_t record, float weight) {
    for (size_t k = 0; k < weights.size(); ++k) {
      if (!(weight > weights[k])) continue;
      std::swap(weight, weights[k]);
      std::swap(record, records[k]);
    }
  };
  around(
      x, y, levels_.size(), [&](const Record& r) { return similarity(r.spot, spot, r.radius); },
      take);
  if (weights[0] < kLeastWeight) {
    weights.fill(0.0f);
    around(
        x, y, levels_.size(),
        [&](const Record& r) {
          return r.object == object ? likeness(r.spot, spot, r.radius) : 0.0f;
        },
        take);
  }
  if (weights[0] < kLeastWeight) return false;
  float sum = 0.0f;
  for (size_t k = 0; k < 4; ++k) {
    out.records[k] = records[k];
    out.weights[k] = weights[k] - (weights[0] > weights[4] ? weights[4] : 0.0f);
    sum += out.weights[k];
  }
  for (float& w : out.weights) w /= sum;
  return true;
}

size_t ViewRecords::bytes() const {
  return records_.size() * (sizeof(Record) + sizeof(Near) + sizeof(vec3)) +
         links_.size() * sizeof(GatherLink);
}

}  // namespace lamplighter
