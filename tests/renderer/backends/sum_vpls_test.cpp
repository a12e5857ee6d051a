// The 8-lane sum against the scalar definition in shaders/shared/vpl_shading.h.
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::LitScene;
using test::makeVpl;

constexpr int kResolution = 32;
constexpr float kClamp = 0.5f, kBias = 0.002f;

Scene blocks() {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.9f, 0.6f, 0.3f));
  test::addMesh(scene, test::squareMesh(6.0f, white));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), white), vec3(0.6f, 0.5f, 0.2f));
  const NodeId turned =
      test::addMesh(scene, test::boxMesh(vec3(0.5f, 2, 0.7f), white), vec3(-1, 1, 0));
  scene.find(turned)->local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(0.3f, 1, 0.1f)));
  return scene;
}

shared::Vpl colored(shared::Vpl vpl, const vec3& intensity) {
  vpl.intensity = intensity;
  return vpl;
}

// One light of each kind. The spot light is oblique, and the cosine light is so near that its
// distance is clamped.
std::vector<shared::Vpl> lights() {
  shared::Vpl spot = makeVpl(vec3(2, 3, 1), vec3(-1, -1.5f, -0.3f), shared::kVplUniform, 1.0f);
  spot.normal.w = 3.0f;
  spot.tangent.w = -2.2f;
  shared::Vpl sun = makeVpl(vec3(0), vec3(0.5f, 1, 0.4f), shared::kVplDirectional, 2.0f);
  sun.normal.w = 5.0f;
  sun.tangent.w = 1.7f;  // covers only part of the scene
  return {colored(makeVpl(vec3(-0.2f, 3, -0.1f), vec3(0.1f, -1, 0.2f)), vec3(3, 2, 1)),
          colored(makeVpl(vec3(0.2f, 0.3f, 1.2f), vec3(0, -1, -0.5f)), vec3(0.2f, 0.5f, 0.1f)),
          colored(spot, vec3(5, 1, 9)), colored(sun, vec3(0.3f, 0.2f, 0.4f))};
}

vec3 expectedRadiance(const LitScene& lit, ManyLightsKernels& kernels, const View& view, int x,
                      int y, const std::vector<shared::Vpl>& vpls) {
  Ray ray{view.eye, 0.0f,
          view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
  const Hit hit = lit.rays->intersect(ray);
  if (!hit) return vec3(0.0f);
  const Surface s = surfaceAt(lit.render, hit.object, hit.triangle, hit.u, hit.v);
  const float side = glm::dot(ray.direction, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
  const vec3 ns = side * s.normal, ng = side * s.geometricNormal;
  vec3 e(0.0f);
  for (size_t i = 0; i < vpls.size(); ++i) {
    const shared::Vpl& vpl = vpls[i];
    const float g = shared::vplGeometry(vpl, s.position, ns, ng, kClamp);
    if (g == 0.0f) continue;
    const bool directional = vpl.position.w == shared::kVplDirectional;
    const vec3 q = shared::vplToLight(vpl, s.position - vec3(vpl.position));
    const vec3 n = shared::vplToLight(vpl, ng);
    const vec2 at = directional ? shared::directionalEncode(vpl, q) : shared::octahedralEncode(q);
    const vec2 texel = shared::shadowTexel(at, kResolution);
    const vec2 centre = shared::shadowTexelCentre(texel, kResolution);
    const size_t index = static_cast<size_t>(texel.y) * kResolution + static_cast<size_t>(texel.x);
    const float stored = kernels.readShadowMap(static_cast<int>(i))[index];
    const bool occluded =
        directional ? shared::directionalOccluded(vpl, stored, q, n, centre, kBias, kResolution)
                    : shared::hemisphereOccluded(stored, q, n, centre, kBias, kResolution);
    if (!occluded) e += g * vpl.intensity;
  }
  return s.albedo / kPi * e;
}

TEST(SumVpls, FollowsTheSharedDefinition) {
  LitScene lit(blocks());
  const View view = test::lookAt(vec3(3, 3, 4), vec3(0, 0.7f, 0), 61, 47, 0.8f);
  const Image image = lit.sum(lights(), view, kResolution, true, kClamp, kBias);
  int wrong = 0, dark = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const vec3 expected = expectedRadiance(lit, *lit.kernels, view, x, y, lights());
      const vec3 d = glm::abs(image.at(x, y) - expected);
      dark += expected == vec3(0.0f);
      wrong += std::max({d.x, d.y, d.z}) > 1e-5f + 1e-4f * expected.g;
    }
  }
  EXPECT_LT(dark, view.width * view.height / 2);
  // Due to rounding, a point may use the neighbouring texel.
  EXPECT_LE(wrong, view.width * view.height / 500);
}

TEST(SumVpls, HasTheSameBitsAtAnyNumberOfThreads) {
  const View view = test::lookAt(vec3(3, 3, 4), vec3(0, 0.7f, 0), 93, 70, 0.8f);
  std::vector<Image> images;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LitScene lit(blocks());
    images.push_back(lit.sum(lights(), view, kResolution));
  }
  EXPECT_TRUE(test::sameBits(images[0], images[1]));
  EXPECT_TRUE(test::sameBits(images[0], images[2]));
}

TEST(CpuBackend, CountsItsWork) {
  // Maps that consist of whole tiles are rasterised, others are traced.
  for (const auto& [resolution, raysAMap] : {std::pair(16u, 0u), {17u, 17u * 17u}}) {
    LitScene lit(blocks());
    const View view = test::lookAt(vec3(3, 3, 4), vec3(0), 20, 10);
    lit.sum(lights(), view, static_cast<int>(resolution));
    const BackendCounts counts = lit.backend->counts();
    const ManyLightsCounts work = lit.kernels->lightCounts();
    EXPECT_EQ(work.shadowMaps, 4u);
    EXPECT_EQ(counts.rays, 4u * raysAMap + 200u);
    EXPECT_EQ(work.lightPixels, 4u * 200u);
    EXPECT_GE(counts.memoryBytes, 4u * resolution * resolution * sizeof(float));
  }
}

TEST(CpuBackend, ShowsTheBackOfAnAreaLightBlack) {
  Scene scene;
  const NodeId light = test::addRectangleLight(scene, vec3(0), vec2(2.0f), vec3(2, 3, 4));
  scene.find(light)->local.rotation = quat(1, 0, 0, 0);  // towards −Z
  scene.sky = vec3(0.5f);
  LitScene lit(scene);
  const Image back = lit.sum({}, test::lookAt(vec3(0, 0.01f, 2), vec3(0), 9, 9, 1.6f), 8);
  EXPECT_EQ(back.at(4, 4), vec3(0.0f));
  EXPECT_EQ(back.at(0, 0), scene.sky.radiance);
}

TEST(CpuBackend, ShowsTheSkyAndEmissionFromTheFrontOnly) {
  Scene scene;
  const int glowing = test::addMaterial(scene, vec3(0.0f), vec3(2, 3, 4));
  test::addMesh(scene, test::squareMesh(2.0f, glowing));
  scene.sky = vec3(0.25f, 0.5f, 0.75f);
  LitScene lit(scene);
  const View above = test::lookAt(vec3(0, 2, 0.01f), vec3(0), 9, 9, 1.6f);
  const View below = test::lookAt(vec3(0, -2, 0.01f), vec3(0), 9, 9, 1.6f);
  const Image front = lit.sum({}, above, 8), back = lit.sum({}, below, 8);
  EXPECT_EQ(front.at(4, 4), vec3(2, 3, 4));
  EXPECT_EQ(back.at(4, 4), scene.sky.radiance);  // back faces are culled
  EXPECT_EQ(front.at(0, 0), scene.sky.radiance);
}

}  // namespace
}  // namespace lamplighter
