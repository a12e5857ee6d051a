// The 8-lane speculars against the scalar definition in shaders/shared/vpl_speculars.h, and their
// incremental updates.
#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"
#include "shaders/shared/vpl_speculars.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::LitScene;
using test::makeVpl;

constexpr int kResolution = 32;
constexpr float kClamp = 0.5f, kBias = 0.002f, kLeast = 0.1f;

Scene blocks() {
  Scene scene;
  test::addMesh(
      scene, test::squareMesh(6.0f, test::addMaterial(scene, vec3(0.9f, 0.6f, 0.3f), 0.0f, 0.3f)));
  test::addMesh(
      scene,
      test::boxMesh(vec3(1.0f), test::addMaterial(scene, vec3(0.9f, 0.7f, 0.3f), 1.0f, 0.5f)),
      vec3(0.6f, 0.5f, 0.2f));
  const NodeId turned = test::addMesh(
      scene, test::boxMesh(vec3(0.5f, 2, 0.7f), test::addMaterial(scene, vec3(0.5f), 0.0f, 1.0f)),
      vec3(-1, 1, 0));
  scene.find(turned)->local.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(0.3f, 1, 0.1f)));
  return scene;
}

// One light of each kind, with and without a footprint.
std::vector<shared::Vpl> lights() {
  std::vector<shared::Vpl> vpls = {
      makeVpl(vec3(-0.2f, 3, -0.1f), vec3(0.1f, -1, 0.2f)),
      makeVpl(vec3(0.2f, 0.4f, 1.2f), vec3(0, -0.3f, -1)),
      makeVpl(vec3(2, 3, 1), vec3(-1, -1.5f, -0.3f), shared::kVplUniform, 1.0f),
      makeVpl(vec3(0), vec3(0.5f, 1, 0.4f), shared::kVplDirectional, 2.0f)};
  vpls[0].footprint.x = 0.4f;
  vpls[1].footprint.x = 3.0f;  // so large that some points are behind its disc
  vpls[2].normal.w = 3.0f;
  vpls[2].tangent.w = -2.2f;
  vpls[3].normal.w = 5.0f;
  vpls[3].tangent.w = 1.7f;  // covers only part of the scene
  vpls[3].footprint.x = 0.05f;
  const vec3 intensities[] = {vec3(3, 2, 1), vec3(0.2f, 0.5f, 0.1f), vec3(5, 1, 9),
                              vec3(0.3f, 0.2f, 0.4f)};
  for (size_t i = 0; i < vpls.size(); ++i) {
    vpls[i].intensity = intensities[i];
    vpls[i].slot = static_cast<int>(i);
  }
  return vpls;
}

shared::ShadingParams paramsOf(bool speculars) {
  return {vec4(kClamp, kBias, kResolution, 8), vec4(1, 0, 0, 0),
          vec4(speculars ? 1.0f : 0.0f, kLeast, 0, 0)};
}

vec3 expectedRadiance(const LitScene& lit, ManyLightsKernels& kernels, const View& view, int x,
                      int y) {
  Ray ray{view.eye, 0.0f,
          view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
  const Hit hit = lit.rays->intersect(ray, Surfaces::seen);
  if (!hit) return vec3(0.0f);
  const Surface s = surfaceAt(lit.render, hit.object, hit.triangle, hit.u, hit.v);
  const Gloss gloss = glossAt(lit.render, hit.object, hit.triangle, hit.u, hit.v);
  const vec3 toEye = -glm::normalize(ray.direction);
  const float nv = glm::dot(s.normal, toEye);
  const shared::Lobe lobe = shared::makeLobe(s.albedo, gloss.metallic, gloss.roughness, kLeast, nv);
  vec3 e(0.0f), speculars(0.0f);
  for (const shared::Vpl& vpl : lights()) {
    const float g = shared::vplGeometry(vpl, s.position, s.normal, s.geometricNormal, kClamp);
    if (g == 0.0f) continue;
    const bool directional = vpl.position.w == shared::kVplDirectional;
    const vec3 q = shared::vplToLight(vpl, s.position - vec3(vpl.position));
    const vec3 n = shared::vplToLight(vpl, s.geometricNormal);
    const vec2 at = directional ? shared::directionalEncode(vpl, q) : shared::octahedralEncode(q);
    const vec2 texel = shared::shadowTexel(at, kResolution);
    const vec2 centre = shared::shadowTexelCentre(texel, kResolution);
    const float stored =
        kernels.readShadowMap(vpl.slot)[static_cast<size_t>(texel.y * kResolution + texel.x)];
    const bool occluded =
        directional ? shared::directionalOccluded(vpl, stored, q, n, centre, kBias, kResolution)
                    : shared::hemisphereOccluded(stored, q, n, centre, kBias, kResolution);
    if (occluded) continue;
    e += g * vpl.intensity;
    speculars +=
        vpl.intensity * shared::vplSpecular(vpl, lobe, s.position, s.normal, toEye, g, kClamp);
  }
  if (!shared::isGlossy(gloss.metallic, gloss.roughness)) return s.albedo / kPi * e;
  const float share = shared::diffuseShare(gloss.metallic, gloss.roughness, kLeast, nv);
  return share * s.albedo / kPi * e + speculars;
}

const View kView = test::lookAt(vec3(3, 3, 4), vec3(0, 0.7f, 0), 61, 47, 0.8f);

TEST(SpecularAccumulator, FollowsTheSharedDefinition) {
  LitScene lit(blocks());
  lit.sum(lights(), kView, kResolution, true, kClamp, kBias);  // renders the shadow maps
  lit.kernels->sumVpls(lights(), paramsOf(true), nullptr);
  const Image image = lit.kernels->compose()->pixels();
  int wrong = 0, dark = 0;
  for (int y = 0; y < kView.height; ++y) {
    for (int x = 0; x < kView.width; ++x) {
      const vec3 expected = expectedRadiance(lit, *lit.kernels, kView, x, y);
      const vec3 d = glm::abs(image.at(x, y) - expected);
      dark += expected == vec3(0.0f);
      wrong += !(std::max({d.x, d.y, d.z}) <= 1e-4f + 2e-3f * expected.g);  // NaN counts as wrong
    }
  }
  EXPECT_LT(dark, kView.width * kView.height / 2);
  // Due to rounding, a point may use the neighbouring texel.
  EXPECT_LE(wrong, kView.width * kView.height / 500);
}

TEST(SpecularAccumulator, AddsSpecularsOnlyIfEnabled) {
  LitScene lit(blocks());
  const Image matt = lit.sum(lights(), kView, kResolution, true, kClamp, kBias);
  lit.kernels->sumVpls(lights(), paramsOf(true), nullptr);
  const Image glossy = lit.kernels->compose()->pixels();
  const Image white = lit.kernels->compose(true)->pixels();
  lit.kernels->sumVpls(lights(), paramsOf(false), nullptr);
  EXPECT_TRUE(test::sameBits(lit.kernels->compose()->pixels(), matt));
  EXPECT_FALSE(test::sameBits(glossy, matt));
  // A picture of white surfaces does not depend on the materials.
  EXPECT_TRUE(test::sameBits(lit.kernels->compose(true)->pixels(), white));
}

// Incremental updates equal a new sum, after a change of a light and of a shadow map.
TEST(SpecularAccumulator, IncrementalUpdatesHaveTheBitsOfANewSum) {
  LitScene lit(blocks());
  lit.sum(lights(), kView, kResolution, true, kClamp, kBias);
  std::vector<shared::Vpl> vpls = lights();
  lit.kernels->sumVpls(vpls, paramsOf(true), nullptr);
  vpls[0].footprint.x = 0.1f;
  vpls[2].intensity.r = 8.0f;
  vpls[1].position.y += 0.4f;
  lit.kernels->renderShadowMaps(std::span(&vpls[1], 1));
  lit.kernels->sumVpls(vpls, paramsOf(true), nullptr);
  const Image kept = lit.kernels->compose()->pixels();

  LitScene fresh(blocks());
  fresh.sum(vpls, kView, kResolution, true, kClamp, kBias);
  fresh.kernels->sumVpls(vpls, paramsOf(true), nullptr);
  EXPECT_TRUE(test::sameBits(kept, fresh.kernels->compose()->pixels()));
}

}  // namespace
}  // namespace lamplighter
