// The inner loop on one core: the cost of a light with a shadow map per pixel, compared with a
// minimal loop. The minimal loop is the bare kernel from the trials that measured this machine: one
// normal, no test of the receiver's plane, sums in floating point.
#include <filesystem>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"
#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/base/data_folder.h"
#include "renderer/base/simd.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

constexpr int kResolution = 64;
constexpr float kClamp2 = 0.25f, kBias = 0.002f;
constexpr int kTilesAtOnce = 16, kLightsAtOnce = 32;  // as in the product

struct LitRoom {
  Scene scene;
  RenderScene render;
  cpu::GBuffer gbuffer;
  std::vector<float> maps;
  std::vector<cpu::LightRecord> lights;

  LitRoom() {
    scene = loadGltf(dataFolder() / "assets/scenes/area_light_room.gltf").scene;
    update(render, scene, SceneChanges::all());
    const RayCaster rays(render);
    for (const Node& node : scene.nodes)
      if (node.camera != kNone)
        cpu::renderGBuffer(render, rays, viewOfCamera(scene, node, 640, 360), vec2(0.0f), gbuffer);
    std::vector<SceneVpl> vpls =
        generateVpls(render, rays, LightSet(render), {300, 0.5f, 1, 1}).vpls;
    constexpr size_t kTexels = size_t{kResolution} * kResolution;
    maps.resize(kTexels * vpls.size());
    for (size_t i = 0; i < vpls.size(); ++i) {
      vpls[i].vpl.slot = static_cast<int>(i);
      cpu::traceShadowMap(rays, vpls[i].vpl, kResolution, 0, kResolution,
                          {&maps[i * kTexels], kTexels});
      lights.push_back(cpu::makeLightRecord(vpls[i].vpl, &maps[i * kTexels], kResolution));
    }
  }
  double lightPixels() const {
    return static_cast<double>(lights.size()) * gbuffer.width * gbuffer.height;
  }
};

const LitRoom& room() {
  static const LitRoom lit;
  return lit;
}

// Eight pixels and one light. Everything that does not depend on the pixel is computed outside the
// loop.
void addBare(const cpu::GBuffer& g, size_t first, const cpu::LightRecord& light,
             std::array<std::vector<float>, 3>& out) {
  const hn::FixedTag<float, cpu::kLanes> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto all = [&](float v) { return hn::Set(d, v); };
  const auto half = all(0.5f * kResolution), last = all(kResolution - 1), zero = hn::Zero(d);
  const auto one = all(1.0f), far = all(1.0f + kBias), clamp2 = all(kClamp2);
  const auto dot = [&](auto x, auto y, auto z, const vec3& v) {
    return hn::MulAdd(x, all(v.x), hn::MulAdd(y, all(v.y), hn::Mul(z, all(v.z))));
  };
  const auto texel = [&](auto s) {
    return hn::Floor(hn::Min(hn::Max(hn::MulAdd(s, half, half), zero), last));
  };
  for (size_t i = first; i < first + cpu::kTilePixels; i += cpu::kLanes) {
    const auto x = hn::Sub(hn::LoadU(d, &g.px[i]), all(light.position.x));
    const auto y = hn::Sub(hn::LoadU(d, &g.py[i]), all(light.position.y));
    const auto z = hn::Sub(hn::LoadU(d, &g.pz[i]), all(light.position.z));
    const auto height = hn::Max(dot(x, y, z, light.normal), zero);
    const auto facing = hn::Max(hn::Neg(hn::MulAdd(x, hn::LoadU(d, &g.sx[i]),
                                                   hn::MulAdd(y, hn::LoadU(d, &g.sy[i]),
                                                              hn::Mul(z, hn::LoadU(d, &g.sz[i]))))),
                                zero);
    const auto u = dot(x, y, z, light.tangent), v = dot(x, y, z, light.bitangent);
    const auto w = hn::Add(hn::Add(hn::Abs(u), hn::Abs(v)), hn::Add(height, all(1e-6f)));
    const auto inverse = hn::Div(one, w);
    const auto s = texel(hn::Mul(hn::Add(u, v), inverse));
    const auto t = texel(hn::Mul(hn::Sub(u, v), inverse));
    const auto stored =
        hn::GatherIndex(d, light.map, hn::ConvertTo(di, hn::MulAdd(t, all(kResolution), s)));
    const auto d2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const auto weight =
        hn::IfThenZeroElse(hn::Gt(hn::Mul(stored, w), far),
                           hn::Div(hn::Mul(facing, height), hn::Mul(d2, hn::Max(d2, clamp2))));
    for (int c = 0; c < 3; ++c) {
      float* to = &out[static_cast<size_t>(c)][i];
      hn::StoreU(hn::MulAdd(weight, all(light.intensity[c]), hn::LoadU(d, to)), d, to);
    }
  }
}

// CPU time, so that other load on the machine has less effect.
void report(benchmark::State& state) {
  state.counters["light_pixels_per_s"] = benchmark::Counter(
      room().lightPixels() * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void bareKernel(benchmark::State& state) {
  const LitRoom& lit = room();
  std::array<std::vector<float>, 3> sums;
  for (auto& v : sums) v.resize(lit.gbuffer.px.size());
  for (auto _ : state) {
    for (int tiles = 0; tiles < lit.gbuffer.tiles(); tiles += kTilesAtOnce)
      for (size_t lights = 0; lights < lit.lights.size(); lights += kLightsAtOnce)
        for (int tile = tiles; tile < std::min(tiles + kTilesAtOnce, lit.gbuffer.tiles()); ++tile)
          for (size_t i = lights; i < std::min(lights + kLightsAtOnce, lit.lights.size()); ++i)
            addBare(lit.gbuffer, static_cast<size_t>(tile) * cpu::kTilePixels, lit.lights[i], sums);
    benchmark::DoNotOptimize(sums[0].data());
  }
  report(state);
}

void ownKernel(benchmark::State& state) {
  const LitRoom& lit = room();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  cpu::IrradianceAccumulator sums;
  for (auto _ : state) {
    sums.forgetMaps();
    sums.update(lit.gbuffer, lit.lights, {kClamp2, kBias, 1.0f}, nullptr);
  }
  report(state);
}

BENCHMARK(bareKernel)->Name("kernel/bare")->Unit(benchmark::kMillisecond);
BENCHMARK(ownKernel)->Name("kernel/own")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamplighter
