#include "renderer/light_field/field_partners.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kShiftSet = 0x5417;
constexpr size_t kReceiversATime = 512;
// Receivers whose normal has a smaller cosine with the lines are traced with rays, because their
// plane is almost parallel to the lines.
constexpr float kGrazing = 0.03f;
// A crossing at most this far in front of the own plane belongs to the own surface [cells].
constexpr float kOwnDepth = 0.1f;
// The own surface covers the centre of the cell if there is a crossing at most this far behind the
// own plane. Curved surfaces leave the plane, and surfaces that they hide may be behind a wall
// [cells].
constexpr float kOwnBehind = 0.1f;

// Traces rays eight at a time, in the order in which they come.
class RayBatch {
 public:
  RayBatch(const FieldGeometry& geometry, const PartnerNumbers& numbers)
      : geometry_(&geometry), numbers_(numbers) {}
  void add(const FieldReceiver& from, const vec3& towards, uint32_t sky, uint32_t& out) {
    rays_[lanes_] = {from.origin, 0.0f, towards};
    sky_[lanes_] = sky;
    out_[lanes_++] = &out;
    if (lanes_ == 8) flush();
  }
  void flush() {
    if (lanes_ == 0) return;
    for (size_t k = lanes_; k < 8; ++k) rays_[k].tFar = -1.0f;
    std::array<Hit, 8> hits;
    bool goesOn = true;
    while (goesOn) {
      hits.fill({});
      geometry_->rays.leastHits8(rays_, hits);
      goesOn = false;
      for (size_t k = 0; k < lanes_; ++k) {
        if (rays_[k].tFar < 0.0f) continue;
        ++traced_;
        const Hit& hit = hits[k];
        if (hit && !geometry_->withLamps && geometry_->scene.objects[hit.object].isAreaLight) {
          rays_[k].tNear = hit.t + rayEpsilon(rays_[k].origin + hit.t * rays_[k].direction);
          goesOn = true;
          continue;
        }
        *out_[k] = hit ? numbers_.of(geometry_->surface.texelAt(geometry_->scene,
                                                                geometry_->atlases, rays_[k], hit))
                       : sky_[k];
        rays_[k].tFar = -1.0f;
      }
    }
    rays_.fill({});
    lanes_ = 0;
  }
  uint64_t traced() const { return traced_; }

 private:
  const FieldGeometry* geometry_;
  PartnerNumbers numbers_;
  std::array<Ray, 8> rays_;
  std::array<uint32_t, 8> sky_{};
  std::array<uint32_t*, 8> out_{};
  size_t lanes_ = 0;
  uint64_t traced_ = 0;
};

enum class Sight : uint8_t { seen, unclear };

// Finds what a receiver sees along the line of a cell. The plane of the receiver is evaluated at
// the centre of the cell, where the crossings are; that of the partner at the receiver's own line.
// `at`: position of the receiver on the grid.
Sight seenAlong(const LineRaster& raster, const glm::ivec2& cell, const vec3& at,
                const FieldReceiver& from, float cosine, const FieldGeometry& geometry,
                const PartnerNumbers& numbers, uint32_t sky, uint32_t& out) {
  const LineGrid& grid = raster.grid();
  const vec2 toMiddle = vec2(cell) + 0.5f - vec2(at);
  const vec2 slope =
      vec2(glm::dot(from.geometricNormal, grid.across), glm::dot(from.geometricNormal, grid.up)) *
      (-grid.cell / cosine);
  const float own = at.z + glm::dot(slope, toMiddle);
  // Depths as seen from the receiver.
  const float sign = cosine > 0.0f ? 1.0f : -1.0f;
  const auto crossings = raster.at(cell.x, cell.y);
  const auto count = static_cast<int>(crossings.size());
  const auto behind = [&](const LineCrossing& c) {
    return sign * (c.depth - own) <= kOwnDepth * grid.cell;
  };
  int next = cosine > 0.0f ? 0 : count - 1;
  const int step = cosine > 0.0f ? 1 : -1;
  while (next >= 0 && next < count && behind(crossings[static_cast<size_t>(next)])) next += step;
  // The last crossing before the partner must be on the surface of the receiver: otherwise the line
  // does not tell what the receiver sees.
  const int before = next - step;
  if (before < 0 || before >= count) return Sight::unclear;
  const LineCrossing& last = crossings[static_cast<size_t>(before)];
  const float tilt = 1.0f + std::abs(slope.x / grid.cell) + std::abs(slope.y / grid.cell);
  const LineTriangle& owner = raster.triangle(last.triangle);
  if (owner.object != from.object || (owner.facesAlong == (sign > 0.0f)) == from.isBack ||
      std::abs(last.depth - own) > kOwnBehind * grid.cell * tilt)
    return Sight::unclear;
  if (next < 0 || next >= count) {
    out = sky;
    return Sight::seen;
  }
  const LineTriangle& partner = raster.triangle(crossings[static_cast<size_t>(next)].triangle);
  // In a corner the plane of the partner may be behind the receiver.
  const float depth = partner.depthAt(vec2(at));
  if (sign * (depth - at.z) <= kOwnDepth * grid.cell) return Sight::unclear;
  if (!partner.hasTexels) {
    out = numbers.dark();
    return Sight::seen;
  }
  const bool isBack = partner.facesAlong == (sign > 0.0f);
  const uint32_t texel =
      geometry.surface.texelAt(partner.object, isBack, partner.texelsAt(vec2(at)));
  out = numbers.of(texel);
  return Sight::seen;
}

// Along the line of its own cell, or of a neighbour on the nearer side: at the border of a surface
// the centre of its own cell may lie outside the surface.
Sight seenNear(const LineRaster& raster, const FieldReceiver& from, float cosine,
               const FieldGeometry& geometry, const PartnerNumbers& numbers, uint32_t sky,
               uint32_t& out) {
  const vec3 at = raster.grid().toGrid(from.position);
  const vec2 low = glm::floor(vec2(at));
  const glm::ivec2 own(low);
  const glm::ivec2 side(at.x - low.x < 0.5f ? -1 : 1, at.y - low.y < 0.5f ? -1 : 1);
  const bool isNearerByX = std::abs(at.x - low.x - 0.5f) > std::abs(at.y - low.y - 0.5f);
  const glm::ivec2 first = isNearerByX ? glm::ivec2(side.x, 0) : glm::ivec2(0, side.y);
  for (const glm::ivec2& step : {glm::ivec2(0), first, side - first, side})
    if (seenAlong(raster, own + step, at, from, cosine, geometry, numbers, sky, out) == Sight::seen)
      return Sight::seen;
  return Sight::unclear;
}

}  // namespace

LineGrid gridOf(const FieldGeometry& geometry, size_t direction) {
  const Frame frame(geometry.directions[direction]);
  const auto number = static_cast<uint32_t>(direction);
  return {frame.tangent,
          frame.bitangent,
          frame.normal,
          geometry.cell,
          {toUnitFloat(hash4(number, geometry.set, 0, kShiftSet)),
           toUnitFloat(hash4(number, geometry.set, 1, kShiftSet))}};
}

PartnerCounts findPartners(const FieldGeometry& geometry, std::span<const PartnerTarget> rows,
                           std::span<LineRaster> rasters) {
  const size_t receivers = geometry.receivers.size();
  const PartnerNumbers numbers{static_cast<uint32_t>(receivers),
                               static_cast<uint32_t>(geometry.directions.size())};
  PartnerCounts counts;
  const bool byLines = geometry.sight == FieldSight::lines;
  if (byLines) {
    tbb::parallel_for(size_t{0}, rows.size(), [&](size_t k) {
      rasters[k].draw(geometry.scene, geometry.surface, gridOf(geometry, rows[k].direction));
    });
    for (size_t k = 0; k < rows.size(); ++k) counts.crossings += rasters[k].crossings();
  }
  std::atomic<uint64_t> rays = 0;
  const size_t groups = (receivers + kReceiversATime - 1) / kReceiversATime;
  tbb::parallel_for(size_t{0}, groups, [&](size_t group) {
    RayBatch batch(geometry, numbers);
    const size_t end = std::min(receivers, (group + 1) * kReceiversATime);
    for (size_t k = 0; k < rows.size(); ++k) {
      const vec3 along = geometry.directions[rows[k].direction];
      for (size_t r = group * kReceiversATime; r < end; ++r) {
        const FieldReceiver& from = geometry.receivers[r];
        const float cosine = glm::dot(from.geometricNormal, along);
        const bool isOpposite = cosine < 0.0f;
        const uint32_t sky =
            from.seesSky ? numbers.sky(rows[k].direction, isOpposite) : numbers.dark();
        uint32_t& partner = rows[k].partners[r];
        if (from.isBuried) {
          partner = numbers.dark();
          continue;
        }
        if (byLines && std::abs(cosine) > kGrazing &&
            seenNear(rasters[k], from, cosine, geometry, numbers, sky, partner) == Sight::seen)
          continue;
        batch.add(from, isOpposite ? -along : along, sky, partner);
      }
    }
    batch.flush();
    rays += batch.traced();
  });
  counts.rays = rays;
  counts.samples = receivers * rows.size();
  return counts;
}

}  // namespace lamplighter
