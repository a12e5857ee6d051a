#include "renderer/base/simd.h"
#include "renderer/light_maps/light_maps.h"

namespace lamplighter {
namespace {

static_assert(LightMaps::Sampler::kPoints == hn::MaxLanes(kTag));
constexpr hn::FixedTag<float, 4> kTexelTag;
using Floats = Floats8;

// Like glm::mix().
template <typename V>
HWY_INLINE V mix(V a, V b, V share) {
  const auto one = hn::Set(hn::DFromV<V>(), 1.0f);
  return hn::Add(hn::Mul(a, hn::Sub(one, share)), hn::Mul(b, share));
}

// Interpolation along one axis of a tile.
struct Along {
  Floats low, share;  // the texel before the point, and the fraction towards the next
  Along(Floats p, float min, float size, float last) {
    const Floats part = hn::Div(hn::Sub(p, broadcast(min)), broadcast(size));
    const Floats at =
        hn::Mul(hn::Min(hn::Max(part, hn::Zero(kTag)), broadcast(1.0f)), broadcast(last));
    low = hn::Min(hn::Floor(at), broadcast(last - 1.0f));
    share = hn::Sub(at, low);
  }
};

}  // namespace

LightMaps::Sampler::Sampler(const LightMaps& maps, const ObjectPatches& patches, uint32_t object,
                            int leaf)
    : chart_(
          patches.charts[static_cast<size_t>(patches.patches[static_cast<size_t>(leaf)].chart)]) {
  const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
  const LightMapTile& tile = *maps.tile(object, leaf);
  min_ = patch.min;
  size_ = patch.max - patch.min;
  last_ = vec2(static_cast<float>(tile.columns - 1), static_cast<float>(tile.rows - 1));
  columns_ = tile.columns;
  texels_ = &maps.objects_[object].irradiance[tile.first];
}

void LightMaps::Sampler::irradiance(const float* x, const float* y, const float* z,
                                    std::span<vec4, kPoints> e) const {
  const SimdVec3<Floats> p{hn::LoadU(kTag, x), hn::LoadU(kTag, y), hn::LoadU(kTag, z)};
  const SimdVec3<Floats> way = p - broadcast(chart_.origin);
  const Along column(dotUnfused(way, broadcast(chart_.tangent)), min_.x, size_.x, last_.x),
      row(dotUnfused(way, broadcast(chart_.bitangent)), min_.y, size_.y, last_.y);
  const Floats first = hn::MulAdd(row.low, broadcast(static_cast<float>(columns_)), column.low);
  alignas(32) int32_t texels[kPoints];
  alignas(32) float across[kPoints], down[kPoints];
  hn::Store(truncateToInts(first), hn::FixedTag<int32_t, kPoints>(), texels);
  hn::Store(column.share, kTag, across);
  hn::Store(row.share, kTag, down);
  for (size_t i = 0; i < kPoints; ++i) {
    const auto load = [&](ptrdiff_t after) {
      return hn::LoadU(kTexelTag, &texels_[texels[i] + after].x);
    };
    const auto u = hn::Set(kTexelTag, across[i]), v = hn::Set(kTexelTag, down[i]);
    const auto top = mix(load(0), load(1), u);
    const auto bottom = mix(load(columns_), load(columns_ + 1), u);
    hn::StoreU(mix(top, bottom, v), kTexelTag, &e[i].x);
  }
}

}  // namespace lamplighter
