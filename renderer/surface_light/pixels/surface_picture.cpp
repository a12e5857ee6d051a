#include "renderer/surface_light/pixels/surface_picture.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/surface_light/pixels/pixel_lobes.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

constexpr float kMost = 65535.0f;

uint16_t packed(float share) {
  return static_cast<uint16_t>(std::clamp(share, 0.0f, 1.0f) * kMost + 0.5f);
}

// A hash of the position in the world and on the triangle, with a chance of collision of 2⁻³¹.
uint32_t keyOf(const GBufferPoint& p, const SeenTriangle& seen) {
  const auto bits = [](float x) { return std::bit_cast<uint32_t>(x); };
  const uint32_t inWorld =
      hash4(bits(p.position.x), bits(p.position.y), bits(p.position.z), p.object);
  const uint32_t onTriangle =
      hash4(p.triangle, bits(seen.weights.x), bits(seen.weights.y), seen.isBack ? 1u : 0u);
  return hash4(inWorld, onTriangle, bits(p.normal.x), bits(p.normal.y)) | 1u;
}

}  // namespace

void SurfacePicture::restart(int width, int height, int samples) {
  width_ = width;
  height_ = height;
  samples_ = samples;
  added_ = 0;
  points_.clear();
  revisions_.clear();
}

size_t SurfacePicture::bytes() const {
  size_t bytes = revisions_.size() * sizeof(uint64_t);
  for (const auto& sample : points_) bytes += sample.size() * sizeof(Point);
  return bytes;
}

void SurfacePicture::add(const GatherScene& in, const SurfaceLight& light,
                         const ViewRecords& records, const GBufferView& gbuffer, const vec3& eye,
                         const SurfacePictureOptions& options, Rows rows, bool withoutLobes) {
  const RenderScene& scene = in.scene;
  const auto sample = static_cast<size_t>(added_);
  if (points_.size() == sample)
    points_.emplace_back(static_cast<size_t>(width_) * static_cast<size_t>(height_));
  std::vector<Point>& points = points_[sample];
  if (rows.last == height_) ++added_;
  const auto show = [&](int x, int y, Point& out) {
    const GBufferPoint p = gbuffer.at(x, y);
    const SeenTriangle seen(scene, p);
    const uint32_t key = keyOf(p, seen);
    if (keepsSame_ && out.key == key) return;
    out = {};
    out.key = key;
    MeshPoint at;
    if (!seen.isSound || !in.mesh.find(scene, p.object, p.triangle, seen.isBack, seen.weights, at))
      return;
    const PixelReflectance r = reflectanceOf(scene, p, seen.weights, eye, options);
    const float even = withoutLobes ? 1.0f - PixelLobes::tracedShare(r.roughness) : 1.0f;
    const vec3 reflectance = r.diffuse + even * r.lobe;
    out.reflectance = {packed(reflectance.r), packed(reflectance.g), packed(reflectance.b)};
    if (!records.isEmpty() && light.trustAt(at) < 1.0f) {
      const uint32_t triangles = scene.objects[p.object].triangleCount();
      ViewRecords::Point found;
      if (records.find(
              x, y, p.object,
              spotAt(scene, p.object,
                     {p.triangle + (seen.isBack ? triangles : 0), seen.weights.x, seen.weights.y}),
              found)) {
        for (size_t k = 0; k < 4; ++k) out.values[k] = kRecord + found.records[k];
        for (size_t k = 1; k < 4; ++k) out.weights[k - 1] = packed(found.weights[k]);
        return;
      }
    }
    std::ranges::copy(at.values, out.values.begin());
    out.weights = {packed(at.weights.y), packed(at.weights.z), 0};
  };
  const cpu::GBuffer& g = gbuffer.packets();
  const auto isSameTile = [&](int x, int y) {
    const size_t tile = g.index(x, y) / cpu::kTilePixels;
    return keepsSame_ && tile < revisions_.size() && revisions_[tile] == g.revision[tile];
  };
  tbb::parallel_for(rows.first, rows.last, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      if (x % cpu::kTileSize == 0 && isSameTile(x, y)) {
        x += cpu::kTileSize - 1;
        continue;
      }
      Point& out =
          points[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
      if (gbuffer.isHit(x, y))
        show(x, y, out);
      else
        out = {};
    }
  });
  if (samples_ == 1) revisions_ = g.revision;
}

void SurfacePicture::addTo(std::span<const vec3> onMesh, std::span<const vec3> ofRecords,
                           Image& picture) const {
  if (added_ == 0 || onMesh.empty()) return;
  const float scale = 1.0f / (kMost * kPi * static_cast<float>(added_));
  const auto light = [&](uint32_t value) {
    return (value & kRecord) != 0 ? ofRecords[value & ~kRecord] : onMesh[value];
  };
  tbb::parallel_for(0, height_, [&](int y) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(width_);
    for (size_t i = first; i < first + static_cast<size_t>(width_); ++i) {
      vec3 sum(0.0f);
      for (int s = 0; s < added_; ++s) {
        const Point& p = points_[static_cast<size_t>(s)][i];
        vec3 irradiance(0.0f);
        float rest = 1.0f;
        for (size_t k = 0; k < p.weights.size(); ++k) {
          if (p.weights[k] == 0) continue;
          const float weight = static_cast<float>(p.weights[k]) / kMost;
          irradiance += weight * light(p.values[k + 1]);
          rest -= weight;
        }
        irradiance += rest * light(p.values[0]);
        sum += vec3(p.reflectance[0], p.reflectance[1], p.reflectance[2]) * irradiance;
      }
      picture.pixels[i] += scale * sum;
    }
  });
}

}  // namespace lamplighter
