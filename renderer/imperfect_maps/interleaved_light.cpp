#include "renderer/imperfect_maps/interleaved_light.h"

#include <algorithm>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/irradiance/simd_light.h"

namespace lamplighter {
namespace {

using cpu::kLanes;
using cpu::Vector3;

// Pixels in packets of eight, by quantity, coordinate and lane.
struct alignas(32) MapPacket {
  float position[3][kLanes], shading[3][kLanes], geometric[3][kLanes];
  float sum[3][kLanes];
};

Vector3 load(const float (&from)[3][kLanes]) {
  return {hn::Load(kTag, from[0]), hn::Load(kTag, from[1]), hn::Load(kTag, from[2])};
}

// Adds a light on a surface, with its map, to the sums of the packets.
void addLight(const cpu::LightRecord& record, const cpu::SumConstants& constants,
              std::span<MapPacket> packets) {
  const cpu::SimdLight light(record, false, constants);
  const cpu::SimdConstants c(constants, record.resolution);
  const Floats8 zero = hn::Zero(kTag);
  for (MapPacket& packet : packets) {
    const Vector3 v = load(packet.position) - light.position;
    const Vector3 geometric = load(packet.geometric);
    const Floats8 z = dotFused(v, light.normal);
    const Floats8 s = hn::Neg(dotFused(v, load(packet.shading)));
    const Floats8 facing = hn::Neg(dotFused(v, geometric));
    auto reached = hn::And(hn::Gt(z, zero), hn::And(hn::Gt(s, zero), hn::Gt(facing, zero)));
    if (hn::AllFalse(kTag, reached)) continue;
    Vector3 turned{zero, zero, zero};
    const auto occluded = cpu::hemisphereOccluded(
        light, c, v, z,
        [&]() -> const Vector3& {
          turned = cpu::inFrameOf(light, geometric);
          return turned;
        },
        facing);
    reached = hn::AndNot(occluded, reached);
    const Floats8 d2 = dotFused(v, v);
    const Floats8 weight = hn::IfThenElseZero(
        reached, hn::Div(hn::Mul(s, z), hn::Mul(d2, hn::Max(d2, c.clampDistance2))));
    const auto add = [&](float* to, Floats8 intensity) {
      hn::Store(hn::MulAdd(weight, intensity, hn::Load(kTag, to)), kTag, to);
    };
    add(packet.sum[0], light.units.x);
    add(packet.sum[1], light.units.y);
    add(packet.sum[2], light.units.z);
  }
}

void take(const cpu::GBuffer& g, size_t from, MapPacket& packet, int lane) {
  const float* const in[9] = {&g.px[from], &g.py[from], &g.pz[from], &g.sx[from], &g.sy[from],
                              &g.sz[from], &g.gx[from], &g.gy[from], &g.gz[from]};
  for (int k = 0; k < 3; ++k) {
    packet.position[k][lane] = *in[k];
    packet.shading[k][lane] = *in[3 + k];
    packet.geometric[k][lane] = *in[6 + k];
    packet.sum[k][lane] = 0.0f;
  }
}

cpu::SumConstants constantsOf(const MapLight& light, const InterleavedOptions& options) {
  cpu::SumConstants out;
  out.clampDistance2 = light.clampDistance * light.clampDistance;
  out.bias = options.shadowBias;
  return out;
}

// Sums the light of one class after the other, with buffers of one thread.
class ClassSum {
 public:
  explicit ClassSum(const InterleavedOptions& options) : options_(options), maps_(options.map) {}

  // Writes the pixels of class c. Each map is drawn and used before the next one, so that it stays
  // in the first-level cache.
  void find(const GBufferView& gbuffer, std::span<const MapLight> lights, const OccluderPool& pool,
            int c, Image& out) {
    const LightRange own = LightRange::ofClass(lights.size(), options_.classes(), c);
    if (own.first == own.last) return;
    takePixels(gbuffer, c);
    for (size_t k = own.first; k < own.last; ++k) {
      const std::span<const float> map = maps_.render(lights[k].vpl, pool.of(k));
      addLight(cpu::makeLightRecord(lights[k].vpl, map.data(), options_.map.resolution),
               constantsOf(lights[k], options_), packets_);
    }
    const float scale =
        static_cast<float>(lights.size()) / static_cast<float>(own.last - own.first);
    for (size_t i = 0; i < pixels_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        out.pixels[pixels_[i]][k] = scale * packets_[i / kLanes].sum[k][i % kLanes];
  }

 private:
  void takePixels(const GBufferView& gbuffer, int c) {
    const auto width = static_cast<size_t>(gbuffer.width());
    pixels_.clear();
    packets_.clear();
    for (int y = c / options_.side; y < gbuffer.height(); y += options_.side) {
      for (int x = c % options_.side; x < gbuffer.width(); x += options_.side) {
        if (!gbuffer.isHit(x, y)) continue;
        const size_t lane = pixels_.size() % kLanes;
        if (lane == 0) packets_.emplace_back();
        pixels_.push_back(static_cast<size_t>(y) * width + static_cast<size_t>(x));
        take(gbuffer.packets(), gbuffer.packets().index(x, y), packets_.back(),
             static_cast<int>(lane));
      }
    }
  }

  InterleavedOptions options_;
  ImperfectMap maps_;
  std::vector<MapPacket> packets_;
  std::vector<size_t> pixels_;  // index in the picture, by packet and lane
};

}  // namespace

OccluderPool poolOf(const OccluderPoints& points) {
  const OccluderPointArrays& a = points.arrays();
  return {{a.px.data(), a.py.data(), a.pz.data(), a.nx.data(), a.ny.data(), a.nz.data(),
           a.area.data(), a.px.size()},
          points.options().pointsPerMap};
}

OccluderSpan OccluderPool::of(size_t light) const {
  if (points.count == 0 || pointsPerMap == 0) return points;
  const size_t blocks = std::max<size_t>(points.count / pointsPerMap, 1);
  const size_t first = light % blocks * pointsPerMap;
  OccluderSpan out = points;
  for (const float** p : {&out.x, &out.y, &out.z, &out.nx, &out.ny, &out.nz, &out.area})
    *p += first;
  out.count = std::min(pointsPerMap, points.count - first);
  return out;
}

LightRange LightRange::ofClass(size_t count, int classes, int c) {
  const auto all = static_cast<size_t>(classes), own = static_cast<size_t>(c);
  return {count * own / all, count * (own + 1) / all};
}

Image sumInterleaved(const GBufferView& gbuffer, std::span<const MapLight> lights,
                     const OccluderPool& pool, const InterleavedOptions& options) {
  Image out(gbuffer.width(), gbuffer.height());
  tbb::enumerable_thread_specific<ClassSum> sums([&] { return ClassSum(options); });
  tbb::parallel_for(
      tbb::blocked_range<int>(0, options.classes(), 1),
      [&](const tbb::blocked_range<int>& range) {
        for (int c = range.begin(); c < range.end(); ++c)
          sums.local().find(gbuffer, lights, pool, c, out);
      },
      tbb::simple_partitioner());
  return out;
}

std::vector<float> imperfectMaps(std::span<const MapLight> lights, size_t first,
                                 const OccluderPool& pool, const ImperfectMapOptions& options) {
  const auto side = static_cast<size_t>(options.resolution);
  std::vector<float> maps(lights.size() * side * side);
  tbb::enumerable_thread_specific<ImperfectMap> scratch([&] { return ImperfectMap(options); });
  tbb::parallel_for(size_t{0}, lights.size(), [&](size_t k) {
    std::ranges::copy(scratch.local().render(lights[k].vpl, pool.of(first + k)),
                      maps.begin() + static_cast<ptrdiff_t>(k * side * side));
  });
  return maps;
}

void addLights(const GBufferView& gbuffer, std::span<const MapLight> lights,
               std::span<const float> maps, int resolution, const InterleavedOptions& options,
               Image& sum) {
  const size_t texels = static_cast<size_t>(resolution) * static_cast<size_t>(resolution);
  const cpu::GBuffer& g = gbuffer.packets();
  tbb::parallel_for(0, gbuffer.height(), [&](int y) {
    std::vector<MapPacket> packets(static_cast<size_t>((gbuffer.width() + kLanes - 1) / kLanes),
                                   MapPacket{});
    for (int x = 0; x < gbuffer.width(); ++x)
      if (gbuffer.isHit(x, y))
        take(g, g.index(x, y), packets[static_cast<size_t>(x / kLanes)], x % kLanes);
    for (size_t k = 0; k < lights.size(); ++k)
      addLight(cpu::makeLightRecord(lights[k].vpl, &maps[k * texels], resolution),
               constantsOf(lights[k], options), packets);
    for (int x = 0; x < gbuffer.width(); ++x)
      for (int i = 0; i < 3; ++i)
        sum.at(x, y)[i] += packets[static_cast<size_t>(x / kLanes)].sum[i][x % kLanes];
  });
}

}  // namespace lamplighter
