// The light of a candle in a dark room, beside a place in the sun.
#pragma once

#include <random>

#include <gtest/gtest.h>

#include "shaders/shared/vpl_shading.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

inline constexpr float kClampDistance = 0.5f;

// A dark room 4 m below a sunlit plain.
inline Scene darkRoomBelowAPlain() {
  Scene scene;
  const int white = addMaterial(scene, vec3(1.0f));
  addMesh(scene, squareMesh(4.0f, white), vec3(0.0f, -4.0f, 0.0f));
  addMesh(scene, squareMesh(20.0f, white));
  return scene;
}
// Of the floor of the room only, which faces upwards.
inline View viewOfFloor() {
  return lookAt(vec3(0.0f, -1.0f, 0.0f), vec3(0.0f, -4.0f, 0.0f), 32, 24, 0.8f);
}

// Light samples on the walls and below the ceiling of the room. Together they give a few lux.
inline std::vector<shared::Vpl> candle(size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> along(-2.0f, 2.0f), height(-3.5f, -1.0f);
  std::vector<shared::Vpl> vpls;
  for (size_t i = 0; i < count; ++i) {
    const float side = i % 2 == 0 ? -2.0f : 2.0f;
    const vec3 at = i % 4 < 2 ? vec3(side, height(random), along(random))
                              : vec3(along(random), -1.0f, along(random));
    const vec3 normal = i % 4 < 2 ? vec3(-side, 0.0f, 0.0f) : vec3(0.0f, -1.0f, 0.0f);
    shared::Vpl vpl = makeVpl(at, normal);
    vpl.intensity = vec3(20.0f, 16.0f, 12.0f) / static_cast<float>(count);
    vpls.push_back(vpl);
  }
  return vpls;
}

// The sun, 100,000 lux, and the light samples of its bounce off the plain. None faces the room: in
// the sums it counts as little as one that is hidden.
inline std::vector<shared::Vpl> sunOnThePlain(size_t count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> along(-10.0f, 10.0f);
  shared::Vpl sun = makeVpl(vec3(0.0f), vec3(0.0f, -1.0f, 0.0f), shared::kVplDirectional);
  sun.normal.w = sun.tangent.w = 20.0f;
  sun.intensity = vec3(1e5f);
  std::vector<shared::Vpl> vpls{sun};
  while (vpls.size() < count) {
    shared::Vpl vpl = makeVpl(vec3(along(random), 0.0f, along(random)), vec3(0.0f, 1.0f, 0.0f));
    vpl.intensity = vec3(1e5f * 400.0f * 0.6f / kPi / static_cast<float>(count));
    vpls.push_back(vpl);
  }
  return vpls;
}

// `count` light samples in all, half of them of the candle: each pixel has the light of those of
// the candle, as if the others were not there and as the sum in double precision gives it.
inline void expectKeepsACandle(std::unique_ptr<Backend> backend, size_t count) {
  LitScene lit(darkRoomBelowAPlain(), std::move(backend));
  const View view = viewOfFloor();
  const std::vector<shared::Vpl> dim = candle(count / 2);
  std::vector<shared::Vpl> all = dim;
  for (const shared::Vpl& vpl : sunOnThePlain(count / 2)) all.push_back(vpl);
  const Image alone = lit.sum(dim, view, 8, false, kClampDistance);
  const Image together = lit.sum(all, view, 8, false, kClampDistance);
  for (int y = 0; y < view.height; y += 5) {
    for (int x = 0; x < view.width; x += 5) {
      const vec3 way =
          view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const vec3 at = view.eye - way * (3.0f / way.y), up(0.0f, 1.0f, 0.0f);
      double e = 0.0;
      for (const shared::Vpl& vpl : dim)
        e += static_cast<double>(vpl.intensity.r) *
             static_cast<double>(shared::vplGeometry(vpl, at, up, up, kClampDistance));
      EXPECT_GT(e, 0.5);
      EXPECT_LT(e, 5.0);
      const auto irradiance = [&](const Image& picture) {
        return static_cast<double>(kPi * picture.at(x, y).r);
      };
      EXPECT_NEAR(irradiance(together) / irradiance(alone), 1.0, 0.001);
      EXPECT_NEAR(irradiance(together) / e, 1.0, 0.002);
    }
  }
}

}  // namespace lamplighter::test
