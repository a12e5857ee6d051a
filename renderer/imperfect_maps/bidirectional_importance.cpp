#include "renderer/imperfect_maps/bidirectional_importance.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/base/simd.h"
#include "renderer/sampling/view_points.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

constexpr size_t kBatch = 8;
constexpr uint32_t kGridSet = 0xb1, kGuideSet = 0xb2;
// The unit of x in the density min(1, 1/x²) of guided samples, which the paper leaves open, as a
// share of the width of the picture.
constexpr float kGuideUnit = 0.05f;
// Texels are averaged if the cosine between their normals is at least the first, and if the sine of
// the angle between their connection and the plane of the texel is at most the second.
constexpr float kSameDirection = 0.8f, kSamePlane = 0.25f;

float luminanceAt(const ReflectiveMap::Texels& t, size_t i) { return luminance(t.intensity(i)); }

// A pixel and its density relative to a uniform one.
struct Guided {
  vec2 pixel{0.0f};
  float density = 1.0f;
  bool isInside = true;
};

// Draws around a centre, which may be outside the picture, with a density in proportion to min(1,
// 1/x²), as far as the farthest corner. x is in `unit` pixels.
Guided drawNear(const vec2& middle, const vec2& size, float unit, vec2 u) {
  const vec2 farthest = glm::max(glm::abs(middle), glm::abs(size - middle));
  const float far = std::max(glm::length(farthest) / unit, 1.0f);
  const float disc = kPi, rest = 2.0f * kPi * std::log(far), all = disc + rest;
  const float angle = 2.0f * kPi * u.y;
  const float pick = u.x * all;
  const float x = pick < disc ? std::sqrt(pick / disc) : std::pow(far, (pick - disc) / rest);
  Guided out;
  out.pixel = middle + unit * x * vec2(std::cos(angle), std::sin(angle));
  const float perArea = std::min(1.0f, 1.0f / (x * x)) / (all * unit * unit);  // [1/pixel²]
  out.density = perArea * size.x * size.y;
  out.isInside =
      out.pixel.x >= 0.0f && out.pixel.y >= 0.0f && out.pixel.x < size.x && out.pixel.y < size.y;
  return out;
}

}  // namespace

float geometryBetween(const vec3& from, const vec3& fromNormal, const vec3& to,
                      const vec3& toNormal, float clampDistance) {
  shared::Vpl vpl{};
  vpl.position = vec4(from, shared::kVplCosine);
  vpl.normal = vec4(fromNormal, 0.0f);
  return shared::vplGeometry(vpl, to, toNormal, toNormal, clampDistance);
}

ViewSamples raySamples(const RenderScene& scene, const RayCaster& rays, const View& view,
                       int count) {
  ViewSamples out;
  for (const SeenPoint& p : seenPoints(scene, rays, view, count)) {
    out.x.push_back(p.position.x);
    out.y.push_back(p.position.y);
    out.z.push_back(p.position.z);
    out.nx.push_back(p.normal.x);
    out.ny.push_back(p.normal.y);
    out.nz.push_back(p.normal.z);
  }
  return out;
}

std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const ViewSamples& samples,
                                           float clampDistance) {
  std::vector<float> out(map.size(), 0.0f);
  if (samples.size() == 0) return out;
  const ReflectiveMap::Texels& t = map.texels();
  const float scale = 1.0f / static_cast<float>(samples.size());
  const Floats8 least = broadcast(clampDistance * clampDistance), zero = hn::Zero(kTag);
  tbb::parallel_for(0, map.columns(), [&](int column) {
    static_assert(ReflectiveMap::kRows % kBatch == 0);
    for (int row = 0; row < ReflectiveMap::kRows; row += static_cast<int>(kBatch)) {
      const size_t first = ReflectiveMap::indexOf(column, row);
      const SimdVec3<Floats8> at{loadAt(t.x, first), loadAt(t.y, first), loadAt(t.z, first)};
      const SimdVec3<Floats8> n{loadAt(t.nx, first), loadAt(t.ny, first), loadAt(t.nz, first)};
      const Floats8 brightness =
          dotFused({loadAt(t.red, first), loadAt(t.green, first), loadAt(t.blue, first)},
                   broadcast(vec3(0.2126f, 0.7152f, 0.0722f)));
      if (hn::AllFalse(kTag, hn::Gt(brightness, zero))) continue;
      Floats8 sum = zero;
      for (size_t i = 0; i < samples.size(); ++i) {
        const SimdVec3<Floats8> way = broadcast(samples.position(i)) - at;
        const Floats8 d2 = dotFused(way, way);
        const Floats8 z = hn::Max(dotFused(way, n), zero);
        const Floats8 s = hn::Max(hn::Neg(dotFused(way, broadcast(samples.normal(i)))), zero);
        const Floats8 below = hn::Max(hn::Mul(d2, hn::Max(d2, least)), broadcast(1e-12f));
        sum = hn::Add(sum, hn::Div(hn::Mul(z, s), below));
      }
      hn::StoreU(hn::Mul(hn::Mul(sum, brightness), broadcast(scale)), kTag, &out[first]);
    }
  });
  return out;
}

std::vector<float> bidirectionalImportance(const ReflectiveMap& map, const GBufferView& gbuffer,
                                           const View& view, const PixelSampleOptions& options) {
  std::vector<float> out(map.size(), 0.0f);
  const ReflectiveMap::Texels& t = map.texels();
  const vec2 size(gbuffer.width(), gbuffer.height());
  // The jittered grid is as square as possible for the number of samples.
  const int across = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(options.count))));
  const int down = std::max(1, options.count / across);
  tbb::parallel_for(0, map.columns(), [&](int column) {
    for (int row = 0; row < ReflectiveMap::kRows; ++row) {
      const size_t i = ReflectiveMap::indexOf(column, row);
      const float brightness = luminanceAt(t, i);
      if (!(brightness > 0.0f)) continue;
      const vec3 image = view.project(t.position(i));
      const bool isGuided = options.guided && image.z > view.znear;
      float sum = 0.0f;
      for (int k = 0; k < across * down; ++k) {
        const auto word = static_cast<uint32_t>(k);
        const auto texel = static_cast<uint32_t>(i);
        const vec2 u(toUnitFloat(hash4(texel, word, options.seed, kGridSet)),
                     toUnitFloat(hash4(texel, word, options.seed, kGuideSet)));
        const vec2 cell((static_cast<float>(k % across) + u.x) / static_cast<float>(across),
                        (static_cast<float>(k / across) + u.y) / static_cast<float>(down));
        Guided at;
        at.pixel = cell * size;
        if (isGuided) at = drawNear(vec2(image.x, image.y), size, kGuideUnit * size.x, cell);
        if (!at.isInside) continue;
        const int x = std::min(static_cast<int>(at.pixel.x), gbuffer.width() - 1);
        const int y = std::min(static_cast<int>(at.pixel.y), gbuffer.height() - 1);
        if (!gbuffer.isHit(x, y)) continue;
        const GBufferPoint p = gbuffer.at(x, y);
        sum += luminance(p.albedo) / at.density *
               geometryBetween(t.position(i), t.normal(i), p.position, p.geometricNormal,
                               options.clampDistance);
      }
      out[i] = brightness * sum / static_cast<float>(across * down);
    }
  });
  return out;
}

std::vector<float> blurred(const ReflectiveMap& map, const std::vector<float>& importance) {
  std::vector<float> out(importance.size(), 0.0f);
  const ReflectiveMap::Texels& t = map.texels();
  for (const ReflectiveMap::Block& block : map.blocks()) {
    tbb::parallel_for(0, block.columns, [&](int column) {
      for (int row = 0; row < ReflectiveMap::kRows; ++row) {
        const size_t i = ReflectiveMap::indexOf(block.first + column, row);
        if (!(luminanceAt(t, i) > 0.0f)) continue;
        float sum = 0.0f, weights = 0.0f;
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, block.columns - 1); ++c) {
          for (int r = std::max(row - 1, 0); r <= std::min(row + 1, ReflectiveMap::kRows - 1);
               ++r) {
            const size_t j = ReflectiveMap::indexOf(block.first + c, r);
            if (!(luminanceAt(t, j) > 0.0f)) continue;
            const vec3 way = t.position(j) - t.position(i);
            const bool isNear =
                glm::dot(t.normal(i), t.normal(j)) >= kSameDirection &&
                std::abs(glm::dot(way, t.normal(i))) <= kSamePlane * glm::length(way);
            if (!isNear && j != i) continue;
            sum += importance[j];
            weights += 1.0f;
          }
        }
        out[i] = sum / weights;
      }
    });
  }
  return out;
}

}  // namespace lamplighter
