// How LowResolution interpolates between its samples.
#include <algorithm>

#include "renderer/backends/cpu/many_lights/carried_light.h"
#include "renderer/backends/cpu/many_lights/low_resolution.h"
#include "renderer/base/simd.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::cpu {
namespace {

using Tag = FloatTag;
using Floats = Floats8;

}  // namespace

// Bilinear, but samples on other surfaces than the pixel count little.
LowResolution::Corners LowResolution::cornersOf(int x, int y) const {
  constexpr float kOtherSurface = 1e-3f, kOtherObject = 0.1f, kLeast = 1e-6f;
  const GBuffer& g = *picture_;
  const size_t pixel = g.index(x, y);
  const vec3 position(g.px[pixel], g.py[pixel], g.pz[pixel]),
      geometric(g.gx[pixel], g.gy[pixel], g.gz[pixel]),
      shading(g.sx[pixel], g.sy[pixel], g.sz[pixel]);
  const int i = x / block_, j = y / block_;
  const vec2 t = perBlock_ * vec2(x - i * block_, y - j * block_);
  Corners corners;
  for (int corner = 0; corner < 4; ++corner) {
    Corner& c = corners[static_cast<size_t>(corner)];
    c.i = std::min(i + corner % 2, samples_.width - 1);
    c.j = std::min(j + corner / 2, samples_.height - 1);
    c.share = (corner % 2 == 0 ? 1.0f - t.x : t.x) * (corner / 2 == 0 ? 1.0f - t.y : t.y);
    const size_t s = samples_.index(c.i, c.j);
    if (samples_.hit[s] == 0) continue;
    const vec3 there(samples_.px[s], samples_.py[s], samples_.pz[s]),
        normal(samples_.sx[s], samples_.sy[s], samples_.sz[s]);
    c.weight = c.share;
    if (shared::isOnSurface(position, geometric, shading, there, normal)) continue;
    const float cosine = std::max(glm::dot(normal, shading), 0.0f);
    c.weight = kLeast + (c.weight + kLeast) * kOtherSurface * cosine * cosine;
    if (samples_.object[s] != g.object[pixel]) c.weight *= kOtherObject;
  }
  return corners;
}

void LowResolution::interpolateAtEdge(int tile, int packet, PacketIrradiance& out) const {
  const int x0 = tile % tilesX_ * kTileSize + packet % kPacketsPerRow * kPacketWidth;
  const int y0 = tile / tilesX_ * kTileSize + packet / kPacketsPerRow * kPacketHeight;
  for (int lane = 0; lane < kLanes; ++lane) {
    const int x = std::min(x0 + lane % kPacketWidth, width_ - 1),
              y = std::min(y0 + lane / kPacketWidth, height_ - 1);
    vec3 sum(0.0f);
    float weights = 0.0f;
    for (const Corner& c : cornersOf(x, y)) {
      const size_t at = static_cast<size_t>(c.j) * rowLength() + static_cast<size_t>(c.i);
      sum += c.weight * vec3(red_[at], green_[at], blue_[at]);
      weights += c.weight;
    }
    if (weights > 0.0f) sum /= weights;
    out.r[lane] = sum.r;
    out.g[lane] = sum.g;
    out.b[lane] = sum.b;
  }
}

void LowResolution::interpolate(int tile, int packet, PacketIrradiance& out) const {
  if ((edges_[static_cast<size_t>(tile)] >> packet & 1) != 0) {
    constexpr uint8_t kAllLanes = (1u << kLanes) - 1;
    if (carried_ == nullptr || carried_->lanes(tile, packet) != kAllLanes)
      interpolateAtEdge(tile, packet, out);
    if (carried_ != nullptr) carried_->read(tile, packet, out);
    return;
  }
  const int x0 = tile % tilesX_ * kTileSize + packet % kPacketsPerRow * kPacketWidth;
  const int y0 = tile / tilesX_ * kTileSize + packet / kPacketsPerRow * kPacketHeight;
  HWY_ALIGN static constexpr float kLaneX[kLanes] = {0, 1, 2, 3, 0, 1, 2, 3};
  HWY_ALIGN static constexpr float kLaneY[kLanes] = {0, 0, 0, 0, 1, 1, 1, 1};
  // 1 / the distance between a cell's samples; the last cell of a row or column may be narrower.
  const auto inverse = [&](int cell, int size) {
    const int width = std::min((cell + 1) * block_, size - 1) - cell * block_;
    if (width == block_) return perBlock_;
    return width > 0 ? 1.0f / static_cast<float>(width) : 0.0f;
  };
  const int i = x0 / block_, j = y0 / block_;
  const size_t at = static_cast<size_t>(j) * rowLength() + static_cast<size_t>(i);
  const auto along = [&](const float* lanes, int first, float scale) {
    return hn::Mul(hn::Add(hn::Load(kTag, lanes), hn::Set(kTag, static_cast<float>(first))),
                   hn::Set(kTag, scale));
  };
  const auto mix = [](Floats a, Floats b, Floats t) { return hn::MulAdd(t, hn::Sub(b, a), a); };
  const Floats ty = along(kLaneY, y0 - j * block_, inverse(j, height_));
  if (block_ >= kPacketWidth) {  // the packet lies in one cell
    const Floats tx = along(kLaneX, x0 - i * block_, inverse(i, width_));
    const auto between = [&](const std::vector<float>& v, float* to) {
      const float* above = v.data() + at;
      const float* below = above + rowLength();
      const Floats top = mix(hn::Set(kTag, above[0]), hn::Set(kTag, above[1]), tx);
      const Floats bottom = mix(hn::Set(kTag, below[0]), hn::Set(kTag, below[1]), tx);
      hn::StoreU(mix(top, bottom, ty), kTag, to);
    };
    between(red_, out.r);
    between(green_, out.g);
    between(blue_, out.b);
    return;
  }
  HWY_ALIGN float t[kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const int x = lane % kPacketWidth;
    t[lane] = static_cast<float>(x % block_) * inverse(i + x / block_, width_);
  }
  const Floats tx = hn::Load(kTag, t);
  const auto between = [&](const std::vector<float>& v, float* to) {
    const float* above = v.data() + at;
    HWY_ALIGN float corners[4][kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      // Past the last cell of a row, lanes are not shown; the index is clamped.
      const int cell = std::min(lane % kPacketWidth / block_, samples_.width - 1 - i);
      for (int corner = 0; corner < 4; ++corner)
        corners[corner][lane] = above[static_cast<size_t>(corner / 2) * rowLength() +
                                      static_cast<size_t>(cell + corner % 2)];
    }
    const Floats top = mix(hn::Load(kTag, corners[0]), hn::Load(kTag, corners[1]), tx);
    const Floats bottom = mix(hn::Load(kTag, corners[2]), hn::Load(kTag, corners[3]), tx);
    hn::StoreU(mix(top, bottom, ty), kTag, to);
  };
  between(red_, out.r);
  between(green_, out.g);
  between(blue_, out.b);
}

}  // namespace lamplighter::cpu
