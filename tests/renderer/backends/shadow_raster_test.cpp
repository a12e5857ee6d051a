// Rasterised shadow maps equal traced ones.
#include "renderer/backends/cpu/shadow_maps/shadow_raster.h"

#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Compared {
  size_t texels = 0, others = 0;  // `others`: texels that differ by more than rounding
  uint64_t rays = 0;
};

// Renders both maps in strips of rows, as the backend does.
Compared compare(const RenderScene& scene, std::span<const shared::Vpl> vpls, int resolution) {
  const RayCaster rays(scene);
  cpu::ShadowRaster raster;
  raster.setScene(scene);
  const cpu::ShadowMapGrid grid(resolution);
  const auto texels = static_cast<size_t>(resolution) * static_cast<size_t>(resolution);
  Compared all;
  for (const shared::Vpl& vpl : vpls) {
    std::vector<float> drawn(texels, -1.0f), traced(texels, -1.0f);
    cpu::traceShadowMap(rays, vpl, resolution, 0, resolution, traced);
    std::vector<uint8_t> isTraced(static_cast<size_t>(resolution / 32 + 1), 0);
    for (int row = 0; row < resolution; row += 32)
      all.rays +=
          raster.render(rays, grid, vpl, row, std::min(row + 32, resolution), drawn, {}, isTraced);
    for (size_t i = 0; i < texels; ++i)
      all.others += std::abs(drawn[i] - traced[i]) > 1e-5f + 1e-4f * traced[i];
    all.texels += texels;
  }
  return all;
}

// A texel centre close to an edge may fall to either side of it.
TEST(ShadowRaster, EqualsTracedMapsInRooms) {
  for (const char* name : {"pillar_room", "area_light_room", "cornell_style", "table_room"}) {
    const RenderScene scene = test::renderSceneOf(test::loadAsset(name));
    for (const int resolution : {8, 24, 64, 96, 256}) {
      const Compared c = compare(scene, test::lightsOf(scene, 8192 / resolution), resolution);
      std::cout << name << " " << resolution << ": " << c.others << " of " << c.texels
                << " texels differ, " << 100 * c.rays / c.texels << "% by rays\n";
      EXPECT_LE(c.others, c.texels / 20000);
      EXPECT_LT(c.rays, c.texels / 2);
    }
  }
}

// Parallel lights from many directions, each over a square part of the room.
TEST(ShadowRaster, OfParallelLightsEqualsTracedMaps) {
  const RenderScene scene = test::renderSceneOf(test::loadAsset("table_room"));
  const float radius = scene.bounds.radius();
  std::vector<shared::Vpl> suns;
  for (int i = 0; i < 40; ++i) {
    const float angle = 2.4f * static_cast<float>(i), height = 0.05f * static_cast<float>(i) - 1.0f;
    const vec3 towards = glm::normalize(vec3(std::cos(angle), height, std::sin(angle)));
    shared::Vpl sun = test::makeVpl(scene.bounds.centre() + 0.02f * static_cast<float>(i), towards,
                                    shared::kVplDirectional, 0.7f * static_cast<float>(i));
    sun.normal.w = 1.1f * radius;
    sun.tangent.w = 0.1f * static_cast<float>(i % 10 + 1) * radius;
    suns.push_back(sun);
  }
  const Compared c = compare(scene, suns, 64);
  std::cout << c.others << " of " << c.texels << " texels differ, " << 100 * c.rays / c.texels
            << "% by rays\n";
  EXPECT_LE(c.others, c.texels / 20000);
  EXPECT_LT(c.rays, c.texels);
}

}  // namespace
}  // namespace lamplighter
