#include "renderer/imperfect_maps/imperfect_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "renderer/imperfect_maps/splat_projection.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// Planes on both sides of a hole are considered equal if their depths in the hole agree within this
// share.
constexpr float kSamePlaneDepth = 0.03f;

}  // namespace

ImperfectMap::ImperfectMap(const ImperfectMapOptions& options)
    : options_(options), side_(static_cast<size_t>(options.resolution)) {
  const size_t count = side_ * side_, padded = count + kSplatLanes;
  texels_.resize(padded);
  point_.resize(padded);
  for (std::vector<float>* v : {&ex_, &ey_, &ez_, &e2_}) v->assign(padded, 0.0f);
  for (size_t i = 0; i < count; ++i) {
    const vec2 texel(static_cast<float>(i % side_), static_cast<float>(i / side_));
    const vec3 e = shared::octahedralDecode(
        shared::shadowTexelCentre(texel, static_cast<float>(options.resolution)));
    ex_[i] = e.x;
    ey_[i] = e.y;
    ez_[i] = e.z;
    e2_[i] = glm::dot(e, e);
  }
}

std::span<const float> ImperfectMap::render(const shared::Vpl& light, const OccluderSpan& points) {
  std::ranges::fill(texels_, 0.0f);
  std::ranges::fill(point_, kNone);
  const SplatProjection projection(light, options_.resolution,
                                   options_.splats == SplatShape::billboard);
  SplatBatch batch;
  const bool keepsPlanes = options_.fill == HoleFilling::planes;
  if (keepsPlanes)
    for (std::vector<float>& v : planes_) v.resize(points.count + kSplatLanes);
  for (size_t first = 0; first < points.count; first += kSplatLanes) {
    uint32_t lanes = projection.project(points, first, batch);
    if (lanes == 0) continue;
    if (keepsPlanes)
      for (size_t k = 0; k < 3; ++k) std::copy_n(batch.plane[k], kSplatLanes, &planes_[k][first]);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(lanes));
      draw(batch, lane, static_cast<uint32_t>(first + lane));
    }
  }
  if (options_.fill == HoleFilling::planes) fillPlanes();
  if (options_.fill == HoleFilling::pullPush) pullPush();
  return std::span(texels_).first(side_ * side_);
}

// On the ray through e the plane of the disc is at 1/w = (n·e)/(n·q). That point, e·w, is in the
// disc where |e − q/w|² ≤ r²/w². Texels beyond the window fail this test on their own.
void ImperfectMap::draw(const SplatBatch& batch, size_t lane, uint32_t point) {
  const auto all = [&](const float(&values)[kSplatLanes]) { return broadcast(values[lane]); };
  const SimdVec3<Floats8> n{all(batch.plane[0]), all(batch.plane[1]), all(batch.plane[2])};
  const SimdVec3<Floats8> twiceQ{all(batch.twiceQ[0]), all(batch.twiceQ[1]), all(batch.twiceQ[2])};
  const Floats8 beyond = all(batch.beyond), zero = hn::Zero(kTag);
  const hn::RebindToUnsigned<FloatTag> words;
  const auto own = hn::Set(words, point);
  const bool keepsPoints = options_.fill == HoleFilling::planes;
  const float *ex = ex_.data(), *ey = ey_.data(), *ez = ez_.data(), *e2 = e2_.data();
  float* const texels = texels_.data();
  const auto left = static_cast<size_t>(batch.left[lane]);
  const auto right = static_cast<size_t>(batch.right[lane]);
  for (int row = batch.top[lane]; row <= batch.bottom[lane]; ++row) {
    const size_t start = static_cast<size_t>(row) * side_;
    for (size_t i = start + left; i <= start + right; i += kSplatLanes) {
      const SimdVec3<Floats8> e{hn::LoadU(kTag, ex + i), hn::LoadU(kTag, ey + i),
                                hn::LoadU(kTag, ez + i)};
      const Floats8 plane = dotFused(n, e), before = hn::LoadU(kTag, texels + i);
      // e² − 2 (e·q)/w + (q² − r²)/w² ≤ 0
      const Floats8 rest = hn::MulAdd(plane, hn::MulSub(plane, beyond, dotFused(e, twiceQ)),
                                      hn::LoadU(kTag, e2 + i));
      const auto isNearer = hn::And(hn::Le(rest, zero), hn::Gt(plane, before));
      hn::StoreU(hn::IfThenElse(isNearer, plane, before), kTag, texels + i);
      if (!keepsPoints) continue;
      const auto ids = hn::LoadU(words, &point_[i]);
      hn::StoreU(hn::IfThenElse(hn::RebindMask(words, isNearer), own, ids), words, &point_[i]);
    }
  }
}

// A hole between two points that lie on one plane gets the depth of that plane.
void ImperfectMap::fillPlanes() {
  const Floats8 zero = hn::Zero(kTag);
  for (size_t first = 0; first < side_ * side_; first += kSplatLanes) {
    uint32_t holes = bitsOf(hn::Eq(loadAt(texels_, first), zero));
    for (; holes != 0; holes &= holes - 1)
      fillHole(first + static_cast<size_t>(std::countr_zero(holes)));
  }
}

void ImperfectMap::fillHole(size_t texel) {
  const auto side = static_cast<int>(side_);
  const int x = static_cast<int>(texel % side_), y = static_cast<int>(texel / side_);
  if (x == 0 || y == 0 || x == side - 1 || y == side - 1) return;
  const vec3 e(ex_[texel], ey_[texel], ez_[texel]);
  const auto depthOf = [&](uint32_t point) {
    return e.x * planes_[0][point] + e.y * planes_[1][point] + e.z * planes_[2][point];
  };
  for (const size_t step : {size_t{1}, side_, side_ + 1, side_ - 1}) {
    const uint32_t a = point_[texel - step], b = point_[texel + step];
    if (a == kNone || b == kNone) continue;
    const float least = std::min(depthOf(a), depthOf(b)), most = std::max(depthOf(a), depthOf(b));
    if (!(least > 0.0f) || most - least > kSamePlaneDepth * most) continue;
    texels_[texel] = least;
    return;
  }
}

// Each level has means of the covered texels below it; holes take the value above them.
void ImperfectMap::pullPush() {
  pyramid_.clear();
  std::vector<float> level(texels_.begin(),
                           texels_.begin() + static_cast<ptrdiff_t>(side_ * side_));
  size_t side = side_;
  pyramid_.push_back(level);
  while (side > 1) {
    const size_t up = side / 2;
    std::vector<float> next(up * up, 0.0f);
    const std::vector<float>& below = pyramid_.back();
    for (size_t y = 0; y < up; ++y) {
      for (size_t x = 0; x < up; ++x) {
        float sum = 0.0f, count = 0.0f;
        for (size_t k = 0; k < 4; ++k) {
          const float v = below[(2 * y + k / 2) * side + 2 * x + k % 2];
          sum += v;
          count += v > 0.0f ? 1.0f : 0.0f;
        }
        next[y * up + x] = count > 0.0f ? sum / count : 0.0f;
      }
    }
    pyramid_.push_back(std::move(next));
    side = up;
  }
  for (size_t l = pyramid_.size() - 1; l-- > 0;) {
    const size_t here = side_ >> l;
    for (size_t y = 0; y < here; ++y)
      for (size_t x = 0; x < here; ++x)
        if (!(pyramid_[l][y * here + x] > 0.0f))
          pyramid_[l][y * here + x] = pyramid_[l + 1][y / 2 * (here / 2) + x / 2];
  }
  std::ranges::copy(pyramid_[0], texels_.begin());
}

bool isInShadow(const shared::Vpl& light, std::span<const float> map, const vec3& at,
                const vec3& normal, float bias) {
  const float side = std::round(std::sqrt(static_cast<float>(map.size())));
  const vec3 q = shared::vplToLight(light, at - vec3(light.position));
  const vec2 texel = shared::shadowTexel(shared::octahedralEncode(q), side);
  return shared::hemisphereOccluded(map[static_cast<size_t>(texel.y * side + texel.x)], q,
                                    shared::vplToLight(light, normal),
                                    shared::shadowTexelCentre(texel, side), bias, side);
}

}  // namespace lamplighter
