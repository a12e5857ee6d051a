// Tests of what both backends provide to every method.
#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/backends/gbuffer_view.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

inline Scene boxesUnderASky() {
  Scene scene = randomBoxes(12, 5);
  scene.sky.kind = SkyKind::gradient;
  scene.sky.zenith = vec3(0.2f, 0.4f, 0.9f);
  scene.sky.horizon = vec3(0.8f);
  scene.sky.ground = vec3(0.1f, 0.08f, 0.05f);
  return scene;
}

// The largest difference relative to the brightest channel.
inline float relativeDifference(const Image& a, const Image& b) {
  float difference = 0.0f, brightest = 0.0f;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      difference = std::max(difference, std::abs(a.pixels[i][c] - b.pixels[i][c]));
      brightest = std::max(brightest, a.pixels[i][c]);
    }
  }
  return difference / brightest;
}

// Reads the irradiance of a light sum from its picture with white surfaces. Composed as an
// irradiance image, it gives the pictures that the kernels compose.
inline void expectComposesAnyIrradiance(std::unique_ptr<Backend> backend) {
  LitScene lit(boxesUnderASky(), std::move(backend));
  // Not a multiple of the size of a tile or packet.
  const View view = lookAt(vec3(0, 3, 7), vec3(0), 75, 43);
  const Image coloured = lit.sum(randomVpls(6, 2), view, 32);
  const Image white = lit.kernels->compose(true)->pixels();
  const GBufferView gbuffer = lit.backend->hostGBuffer();
  Image irradiance(view.width, view.height);
  int hits = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      ++hits;
      irradiance.at(x, y) = kPi * white.at(x, y);
    }
  }
  EXPECT_GT(hits, view.width * view.height / 4);
  EXPECT_LT(hits, view.width * view.height);
  for (int repeat = 0; repeat < 2; ++repeat) {
    EXPECT_LT(relativeDifference(coloured, lit.backend->compose(irradiance, false)->pixels()),
              1e-6f);
    EXPECT_LT(relativeDifference(white, lit.backend->compose(irradiance, true)->pixels()), 1e-6f);
  }
  // Composing an image does not change the stored light sum.
  EXPECT_TRUE(sameBits(coloured, lit.kernels->compose()->pixels()));
}

// The G-buffer in main memory equals the hits of primary rays, also with jitter and after an edit.
inline void expectHostGBufferEqualsRayHits(std::unique_ptr<Backend> backend) {
  Scene scene = boxesUnderASky();
  LitScene lit(scene, std::move(backend));
  const auto check = [&](const View& view, vec2 jitter) {
    lit.backend->renderGBuffer(view, jitter);
    const GBufferView gbuffer = lit.backend->hostGBuffer();
    ASSERT_EQ(gbuffer.width(), view.width);
    ASSERT_EQ(gbuffer.height(), view.height);
    int edges = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        const vec3 towards = view.rayDirection(static_cast<float>(x) + 0.5f + jitter.x,
                                               static_cast<float>(y) + 0.5f + jitter.y);
        const Hit hit = lit.rays->intersect({view.eye, 0.0f, towards}, Surfaces::seen);
        const bool isSame = gbuffer.isHit(x, y) == static_cast<bool>(hit) &&
                            (!hit || (gbuffer.at(x, y).object == hit.object &&
                                      gbuffer.at(x, y).triangle == hit.triangle));
        if (!isSame) ++edges;
        if (!isSame || !hit) continue;
        const GBufferPoint point = gbuffer.at(x, y);
        EXPECT_LT(glm::distance(point.position, view.eye + hit.t * towards), 1e-4f);
        EXPECT_NEAR(glm::length(point.normal), 1.0f, 1e-4f);
        EXPECT_LE(glm::dot(point.geometricNormal, towards), 0.0f);
      }
    }
    EXPECT_LE(edges, 4);  // rays through an edge may hit either of its two triangles
  };
  check(lookAt(vec3(0, 3, 7), vec3(0), 60, 33), vec2(0.0f));
  check(lookAt(vec3(0, 3, 7), vec3(0), 60, 33), vec2(0.3f, -0.2f));
  const Scene before = scene;
  for (Node& node : scene.nodes) node.local.translation.x += 0.25f;
  const RenderSceneChanges changes = update(lit.render, scene, compare(before, scene));
  lit.rays->update(changes);
  lit.backend->setScene(lit.render, changes, *lit.rays);
  check(lookAt(vec3(0, 3, 7), vec3(0), 60, 33), vec2(0.0f));
  check(lookAt(vec3(2, 3, 6), vec3(0), 40, 40), vec2(0.0f));
}

}  // namespace lamplighter::test
