// Shadow maps of points, and sums of lights with them.
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/imperfect_maps/interleaved_light.h"
#include "renderer/imperfect_maps/occluder_points.h"
#include "renderer/imperfect_maps/rest_maps.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr int kSide = 64;

// Points of a scene for one map.
struct MapPoints {
  MapPoints(const RenderScene& scene, uint32_t count, uint32_t maps = 1) {
    OccluderPointOptions options;
    options.pointsPerMap = count;
    options.points = maps * count;
    points.update(scene, test::everythingRebuilt(), {}, {}, options);
  }
  OccluderPool pool() const { return poolOf(points); }
  OccluderPoints points;
};

TEST(ImperfectMap, ShadesNothingInAnEmptyConvexRoom) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 5.0f)));
  const RenderScene render = test::renderSceneOf(scene);
  const MapPoints points(render, 8192);
  ImperfectMap map({kSide, SplatShape::tilted, HoleFilling::planes});
  const shared::Vpl light = test::makeVpl(vec3(0.4f, -1.4999f, 0.3f), vec3(0, 1, 0));
  const std::span<const float> texels = map.render(light, points.pool().of(0));
  int dark = 0, all = 0;
  for (float x = -1.95f; x < 2.0f; x += 0.1f) {
    for (float z = -2.45f; z < 2.5f; z += 0.1f, ++all)
      dark += isInShadow(light, texels, vec3(x, 1.5f, z), vec3(0, -1, 0), 0.002f);
    for (float y = -1.4f; y < 1.5f; y += 0.1f, ++all)
      dark += isInShadow(light, texels, vec3(x, y, 2.5f), vec3(0, 0, -1), 0.002f);
  }
  EXPECT_LT(dark, all / 200) << all;
  // Nearly all texels see the room; holes are left in its corners.
  EXPECT_LT(std::ranges::count(texels, 0.0f), kSide * kSide / 25);
}

TEST(ImperfectMap, BecomesTheTracedMapWithManyPoints) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 5.0f)));
  test::addMesh(scene, test::boxMesh(vec3(1.0f, 0.2f, 0.6f)), vec3(0.0f, 0.2f, 0.0f));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  const shared::Vpl light = test::makeVpl(vec3(0.4f, -1.4999f, 0.3f), vec3(0, 1, 0));
  std::vector<float> traced(kSide * kSide);
  cpu::traceShadowMap(rays, light, kSide, 0, kSide, traced);
  const auto wrong = [&](uint32_t count) {
    const MapPoints points(render, count);
    ImperfectMap map({kSide, SplatShape::tilted, HoleFilling::planes});
    const std::span<const float> drawn = map.render(light, points.pool().of(0));
    int differ = 0;
    for (size_t i = 0; i < traced.size(); ++i)
      differ += std::abs(drawn[i] - traced[i]) > 0.01f * traced[i];
    return static_cast<double>(differ) / (kSide * kSide);
  };
  const double few = wrong(2048), many = wrong(131072);
  EXPECT_LT(many, 0.03);
  EXPECT_LT(many, 0.5 * few);
}

// Points on a plane around a hole: it is filled with the depth of the plane. On a step, it is open
// or has the depth of one of both planes, and not one between them.
TEST(ImperfectMap, FillsOnlyPlanes) {
  const shared::Vpl light = test::makeVpl(vec3(0.0f), vec3(0, 0, 1), shared::kVplCosine, 0.0f);
  const auto holeOf = [&](float stepHeight, HoleFilling fill) {
    std::vector<float> x, y, z, nx, ny, nz, area;
    for (float u = -1.0f; u < 1.0f; u += 0.025f) {
      for (float v = -1.0f; v < 1.0f; v += 0.025f) {
        if (std::abs(u) < 0.04f && std::abs(v) < 0.04f) continue;  // the hole
        x.push_back(u);
        y.push_back(v);
        z.push_back(u < 0.0f ? 2.0f : 2.0f + stepHeight);
        nx.push_back(0.0f);
        ny.push_back(0.0f);
        nz.push_back(-1.0f);
        area.push_back(0.025f * 0.025f);
      }
    }
    const size_t count = x.size();
    for (std::vector<float>* list : {&x, &y, &z, &nx, &ny, &nz, &area}) list->resize(count + 8);
    ImperfectMap map({kSide, SplatShape::tilted, fill});
    const auto texels = map.render(
        light, {x.data(), y.data(), z.data(), nx.data(), ny.data(), nz.data(), area.data(), count});
    return texels[kSide / 2 * kSide + kSide / 2];
  };
  EXPECT_EQ(holeOf(0.0f, HoleFilling::none), 0.0f);
  // w of the texel's centre on the plane z = 2.
  EXPECT_NEAR(holeOf(0.0f, HoleFilling::planes), 0.5f, 0.01f);
  EXPECT_GT(holeOf(0.0f, HoleFilling::pullPush), 0.4f);
  EXPECT_GT(holeOf(1.0f, HoleFilling::pullPush), 0.3f);
  const float kept = holeOf(1.0f, HoleFilling::planes);
  EXPECT_TRUE(kept == 0.0f || std::abs(kept - 0.5f) < 0.01f || std::abs(kept - 1.0f / 3.0f) < 0.01f)
      << kept;
}

// Lights above the floor of a room with a box.
struct LitRoom {
  LitRoom() {
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f)));
    test::addMesh(scene, test::boxMesh(vec3(0.8f)), vec3(0.0f, -1.1f, 0.0f));
    render = test::renderSceneOf(scene);
    rays = std::make_unique<RayCaster>(render);
    backend->setScene(render, test::everythingRebuilt(), *rays);
    backend->renderGBuffer(view, vec2(0.0f));
    for (int i = 0; i < 32; ++i) {
      const float u = static_cast<float>(i) / 32.0f;
      lights.push_back({test::makeVpl(vec3(3.6f * u - 1.8f, 1.499f, std::sin(40.0f * u)),
                                      vec3(0, -1, 0), shared::kVplCosine, u)});
    }
  }
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  std::unique_ptr<Backend> backend = makeCpuBackend();
  View view = test::lookAt(vec3(1.8f, 0.9f, 1.8f), vec3(0.0f, -1.0f, 0.0f), 80, 60);
  std::vector<MapLight> lights;
};

void addClass(LitRoom& room, int c, const OccluderPool& pool, const InterleavedOptions& options,
              Image& sum) {
  const LightRange range = LightRange::ofClass(room.lights.size(), options.classes(), c);
  const auto own = std::span(room.lights).subspan(range.first, range.last - range.first);
  addLights(room.backend->hostGBuffer(), own, imperfectMaps(own, range.first, pool, options.map),
            kSide, options, sum);
}

double largestDifference(const Image& a, const Image& b) {
  double most = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, static_cast<double>(glm::length(a.pixels[i] - b.pixels[i])));
  return most;
}

TEST(InterleavedLight, ClassesTogetherAreThePlainSum) {
  LitRoom room;
  const MapPoints points(room.render, 2048, 4);
  InterleavedOptions plain, divided;
  plain.side = 1;
  divided.side = 4;
  const GBufferView gbuffer = room.backend->hostGBuffer();
  const Image all = sumInterleaved(gbuffer, room.lights, points.pool(), plain);
  Image classes(room.view.width, room.view.height);
  for (int c = 0; c < divided.classes(); ++c) addClass(room, c, points.pool(), divided, classes);
  EXPECT_GT(test::meanOf(all).g, 0.1f);
  EXPECT_LT(largestDifference(all, classes), 1e-3 * static_cast<double>(test::meanOf(all).g));
}

TEST(InterleavedLight, EachPixelHasTheLightsOfItsClass) {
  LitRoom room;
  const MapPoints points(room.render, 2048, 4);
  InterleavedOptions options;
  options.side = 4;
  const GBufferView gbuffer = room.backend->hostGBuffer();
  const Image sum = sumInterleaved(gbuffer, room.lights, points.pool(), options);
  for (const int c : {0, 5, 15}) {
    Image own(room.view.width, room.view.height);
    addClass(room, c, points.pool(), options, own);
    for (int y = c / 4; y < room.view.height; y += 4)
      for (int x = c % 4; x < room.view.width; x += 4)
        EXPECT_NEAR(sum.at(x, y).g, 16.0f * own.at(x, y).g, 1e-5f * (1.0f + sum.at(x, y).g));
  }
}

TEST(InterleavedLight, TracedMapsShowWhatRaysShow) {
  LitRoom room;
  const InterleavedOptions options;
  const GBufferView gbuffer = room.backend->hostGBuffer();
  Image shown(room.view.width, room.view.height);
  RestMaps maps;
  maps.draw(room.render, *room.rays, room.lights, 256);
  addLights(gbuffer, room.lights, maps.maps(), 256, options, shown);
  double squares = 0.0, mean = 0.0;
  for (int y = 0; y < room.view.height; ++y) {
    for (int x = 0; x < room.view.width; ++x) {
      const GBufferPoint p = gbuffer.at(x, y);
      float light = 0.0f;
      for (const auto& [v, clampDistance] : room.lights) {
        const float g =
            shared::vplGeometry(v, p.position, p.normal, p.geometricNormal, clampDistance);
        const vec3 from = p.position + rayEpsilon(p.position) * p.geometricNormal;
        if (g > 0.0f && !room.rays->occluded({from, 0.0f, vec3(v.position) - from, 1.0f}))
          light += g;
      }
      squares += std::pow(static_cast<double>(light - shown.at(x, y).g), 2.0);
      mean += static_cast<double>(light);
    }
  }
  const double count = room.view.width * room.view.height;
  EXPECT_LT(std::sqrt(squares / count) / (mean / count), 0.02);
}

TEST(InterleavedLight, DoesNotDependOnThreads) {
  LitRoom room;
  const MapPoints points(room.render, 2048, 4);
  const GBufferView gbuffer = room.backend->hostGBuffer();
  const Image all = sumInterleaved(gbuffer, room.lights, points.pool(), {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(test::sameBits(all, sumInterleaved(gbuffer, room.lights, points.pool(), {})));
}

TEST(InterleavedLight, BlurKeepsConstants) {
  LitRoom room;
  const GBufferView gbuffer = room.backend->hostGBuffer();
  const Image blurred =
      blurredClasses(gbuffer, Image(room.view.width, room.view.height, vec3(0.7f)), 8);
  for (int y = 0; y < room.view.height; ++y)
    for (int x = 0; x < room.view.width; ++x)
      EXPECT_NEAR(blurred.at(x, y).r, gbuffer.isHit(x, y) ? 0.7f : 0.0f, 1e-5f);
}

}  // namespace
}  // namespace lamplighter
