// The path tracer with a specular lobe at every surface of a path: against closed forms and
// quadrature of shaders/shared/brdf.h.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "shaders/shared/brdf.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr float kLeast = 0.05f;  // of the roughness

PathTracerOptions glossyPaths(int bounces, bool glossyBounces = true) {
  return {.bounces = bounces,
          .speculars = true,
          .leastRoughness = kLeast,
          .glossyBounces = glossyBounces};
}

struct Estimate {
  double mean = 0.0, greatest = 0.0;  // green, over samples
};

Estimate estimate(uint32_t samples, const std::function<vec3(uint32_t)>& sample) {
  Estimate e;
  for (uint32_t i = 0; i < samples; ++i) {
    const double value = static_cast<double>(sample(i).g);
    e.mean += value / samples;
    e.greatest = std::max(e.greatest, value);
  }
  return e;
}

// The irradiance at a point of the floor, whose normal is +Y.
Estimate irradianceAt(const Scene& scene, const vec3& x, const PathTracerOptions& options,
                      uint32_t samples) {
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  const LightSet lights(world);
  return estimate(samples, [&](uint32_t i) {
    return traceIrradiance(world, rays, lights, {.position = x}, 0, i, options);
  });
}

Image glossyPicture(const Scene& scene, const View& view, int samples,
                    const PathTracerOptions& options) {
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  const LightSet lights(world);
  Image image(view.width, view.height);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      for (int i = 0; i < samples; ++i)
        image.at(x, y) +=
            tracePath(world, rays, lights, view, x, y, static_cast<uint32_t>(i), options) /
            static_cast<float>(samples);
  return image;
}

struct MaterialValues {
  float colour, metallic, roughness;
};

// f · cos for light from `light`, seen from `eye`; both in the frame of the normal (+Z).
double reflectedShare(const MaterialValues& m, const vec3& eye, const vec3& light) {
  const vec3 base(m.colour);
  const shared::Lobe lobe = shared::makeLobe(base, m.metallic, m.roughness, kLeast, eye.z);
  const float diffuse = shared::diffuseShare(m.metallic, m.roughness, kLeast, eye.z) * m.colour;
  const vec3 f = shared::lobeTowards(lobe, light.z, glm::dot(light, eye), 0.0f) + diffuse / kPi;
  return light.z > 0.0f ? static_cast<double>(f.g * light.z) : 0.0;
}

// ∫ f cos dω of a metal, over half vectors in proportion to the microfacet distribution.
double metalAlbedo(float roughness, float cosine) {
  constexpr int n = 120;
  const vec3 eye(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  const float a2 = std::pow(roughness, 4.0f);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / n;
    const float nh = std::sqrt((1.0f - u) / (1.0f + (a2 - 1.0f) * u));
    for (int j = 0; j < n; ++j) {
      const float phi = 2.0f * kPi * (static_cast<float>(j) + 0.5f) / n;
      const float sine = std::sqrt(1.0f - nh * nh);
      const vec3 half(sine * std::cos(phi), sine * std::sin(phi), nh);
      const float vh = glm::dot(eye, half);
      if (vh <= 0.0f) continue;
      const float d = nh * nh * (a2 - 1.0f) + 1.0f;
      const float pdf = a2 / (kPi * d * d) * nh / (4.0f * vh);
      sum += reflectedShare({1.0f, 1.0f, roughness}, eye, 2.0f * vh * half - eye) /
             static_cast<double>(pdf);
    }
  }
  return sum / (n * n);
}

// A closed room whose walls emit the radiance 1 and reflect nothing, and a plate of white metal
// 1 m above the place, facing down. The radiance of the plate is its directional albedo, which is
// below 1 because light that microfacets reflect more than once is lost.
TEST(GlossyBounces, AWhiteMetalInAFurnaceHasTheSingleScatteringAlbedo) {
  constexpr int n = 200;
  constexpr float kSide = 8.0f;
  for (const float roughness : {0.2f, 0.6f}) {
    Scene scene;
    const int wall = test::addMaterial(scene, vec3(0.0f), vec3(1.0f));
    const int metal = test::addMaterial(scene, vec3(1.0f), 1.0f, roughness);
    test::addMesh(scene, test::roomMesh(vec3(12.0f), wall));
    const NodeId plate = test::addMesh(scene, test::squareMesh(kSide, metal), vec3(0, 1, 0));
    scene.find(plate)->local.rotation = glm::angleAxis(kPi, vec3(1, 0, 0));

    double expected = 0.0;  // irradiance / π, over u = sin² θ
    for (int i = 0; i < n; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / n, cosine = std::sqrt(1.0f - u);
      const double albedo = metalAlbedo(roughness, cosine);
      for (int j = 0; j < n; ++j) {
        const float phi = 2.0f * kPi * (static_cast<float>(j) + 0.5f) / n;
        const vec2 at = std::sqrt(u) / cosine * vec2(std::cos(phi), std::sin(phi));
        const bool hits = std::max(std::abs(at.x), std::abs(at.y)) < 0.5f * kSide;
        expected += (hits ? albedo : 1.0) / (n * n);
      }
    }
    const double measured =
        irradianceAt(scene, vec3(0), glossyPaths(1), 1 << 18).mean / static_cast<double>(kPi);
    std::printf("roughness %.1f: %.5f, expected %.5f\n", roughness, measured, expected);
    EXPECT_NEAR(measured / expected, 1.0, 1.5e-3);
    EXPECT_LT(measured, 1.0);
  }
}

// The place at (−0.6, 0, 0) lies behind a lamp, which faces a plate. Only the plate sends it light.
struct LampAndPlate {
  static constexpr float kPlateX = 0.3f, kLampX = -0.5f;
  static constexpr float kRadiance = 5.0f;
  static constexpr vec3 kPlace{-0.6f, 0, 0}, kPlateAt{kPlateX, 0.9f, 0}, kLampAt{kLampX, 1.2f, 0};
  static constexpr vec2 kLampSize{1.6f, 1.2f};  // along Z and Y
  Scene scene;
  NodeId plate, lamp;

  LampAndPlate(const MaterialValues& m, float side) {
    const int material = test::addMaterial(scene, vec3(m.colour), m.metallic, m.roughness);
    plate = test::addMesh(scene, test::squareMesh(side, material), kPlateAt);
    scene.find(plate)->local.rotation = glm::angleAxis(0.5f * kPi, vec3(0, 0, 1));
    lamp = test::addRectangleLight(scene, kLampAt, kLampSize, vec3(kRadiance));
    scene.find(lamp)->local.rotation = glm::angleAxis(-0.5f * kPi, vec3(0, 1, 0));
  }
};

// Point (i, j) of n × n in a rectangle across X.
vec3 pointOf(const vec3& centre, const vec2& size, int i, int j, int n) {
  const auto at = [n](int k) { return (static_cast<float>(k) + 0.5f) / static_cast<float>(n); };
  return centre + vec3(0, size.y * (at(i) - 0.5f), size.x * (at(j) - 0.5f));
}

// A nearly perfect mirror throws the light of the mirrored lamp, times Schlick's reflectance:
//   E = ∫ L F(θ) cos θ' cos θ / r² dA over the mirrored lamp, θ at the mirror and at the lamp.
// By multiple importance sampling no path has more than twice the lamp's radiance.
TEST(GlossyBounces, AMirrorThrowsTheLightOfTheMirroredLamp) {
  using Room = LampAndPlate;
  constexpr float kColour = 0.7f;
  Room room({kColour, 1.0f, 0.0f}, 5.0f);
  constexpr int n = 200;
  const vec3 mirrored(2.0f * Room::kPlateX - Room::kLampX, Room::kLampAt.y, 0);
  double expected = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const vec3 d = pointOf(mirrored, Room::kLampSize, i, j, n) - Room::kPlace;
      const float r2 = glm::dot(d, d), r = std::sqrt(r2), cosine = d.x / r;
      const float fresnel = kColour + (1.0f - kColour) * std::pow(1.0f - cosine, 5.0f);
      expected += static_cast<double>(Room::kRadiance * fresnel * cosine * d.y / (r * r2));
    }
  expected *= static_cast<double>(Room::kLampSize.x * Room::kLampSize.y) / (n * n);
  const Estimate e = irradianceAt(room.scene, Room::kPlace, glossyPaths(1), 1 << 21);
  std::printf("%.5f, expected %.5f, greatest %.3f\n", e.mean, expected, e.greatest);
  EXPECT_NEAR(e.mean / expected, 1.0, 3e-3);
  EXPECT_LT(e.greatest, static_cast<double>(2.0f * kPi * Room::kRadiance));
  // As Lambertian surface it sends another amount.
  const Estimate matt = irradianceAt(room.scene, Room::kPlace, glossyPaths(1, false), 1 << 16);
  EXPECT_GT(std::abs(matt.mean / expected - 1.0), 0.2);
}

// The same with wide lobes, against quadrature over the plate and the lamp.
TEST(GlossyBounces, AGlossyPlateThrowsTheIntegralOfItsBrdf) {
  using Room = LampAndPlate;
  constexpr int n = 40;
  constexpr float kSide = 1.6f;
  for (const MaterialValues& m :
       {MaterialValues{0.8f, 1.0f, 0.4f}, MaterialValues{0.3f, 0.0f, 0.4f},
        MaterialValues{0.5f, 0.5f, 0.7f}}) {
    const Room room(m, kSide);
    double expected = 0.0;
    for (int i = 0; i < n * n; ++i) {
      const vec3 p = pointOf(Room::kPlateAt, vec2(kSide), i / n, i % n, n);
      const vec3 d = p - Room::kPlace;
      const float r2 = glm::dot(d, d), r = std::sqrt(r2);
      const vec3 eye = vec3(d.z, -d.y, d.x) / r;  // in the plate's frame: its normal is −X
      double sent = 0.0;
      for (int j = 0; j < n * n; ++j) {
        const vec3 to = pointOf(Room::kLampAt, Room::kLampSize, j / n, j % n, n) - p;
        const float s2 = glm::dot(to, to), s = std::sqrt(s2);
        const vec3 light = vec3(-to.z, to.y, -to.x) / s;
        sent += reflectedShare(m, eye, light) * static_cast<double>(light.z / s2);
      }
      expected += sent * static_cast<double>(d.y / r * eye.z / r2);
    }
    expected *= static_cast<double>(Room::kRadiance * Room::kLampSize.x * Room::kLampSize.y *
                                    kSide * kSide) /
                std::pow(n, 4);
    const Estimate e = irradianceAt(room.scene, Room::kPlace, glossyPaths(1), 1 << 21);
    std::printf("%.5f, expected %.5f\n", e.mean, expected);
    EXPECT_NEAR(e.mean / expected, 1.0, 5e-3) << m.metallic << ' ' << m.roughness;
  }
}

// Light that the plate is excluded from is not thrown by it.
TEST(GlossyBounces, LightLinkingIsThatOfTheSurface) {
  LampAndPlate room({0.9f, 1.0f, 0.2f}, 3.0f);
  const Estimate lit = irradianceAt(room.scene, room.kPlace, glossyPaths(2), 4096);
  EXPECT_GT(lit.mean, 0.0);
  room.scene.find(room.lamp)->light.leftOut = {room.plate};
  const Estimate dark = irradianceAt(room.scene, room.kPlace, glossyPaths(2), 4096);
  EXPECT_EQ(dark.greatest, 0.0);
}

// A texture multiplies roughness (green) and metal (blue), bit for bit.
TEST(GlossyBounces, TexturesOfRoughnessAndMetalCount) {
  const auto with = [](const MaterialValues& m, const std::array<uint8_t, 4>& texel) {
    LampAndPlate room(m, 3.0f);
    auto image = std::make_shared<Image8>(1, 1);
    std::copy(texel.begin(), texel.end(), image->at(0, 0));
    room.scene.textures.push_back({"gloss", image});
    room.scene.materials[0].metallicRoughnessTexture.texture = 0;
    return irradianceAt(room.scene, room.kPlace, glossyPaths(1), 4096).mean;
  };
  const double metal = with({0.9f, 1.0f, 0.4f}, {0, 255, 255, 255});
  EXPECT_EQ(with({0.9f, 1.0f, 0.4f}, {0, 255, 0, 255}),
            with({0.9f, 0.0f, 0.4f}, {0, 255, 255, 255}));
  EXPECT_EQ(with({0.9f, 1.0f, 0.4f}, {0, 0, 255, 255}),
            with({0.9f, 1.0f, 0.0f}, {0, 255, 255, 255}));
  EXPECT_NE(with({0.9f, 1.0f, 0.4f}, {0, 255, 0, 255}), metal);
  EXPECT_NE(with({0.9f, 1.0f, 0.4f}, {0, 0, 255, 255}), metal);
}

// Two mirrors at a right angle send the view back to where it comes from: above the camera.
TEST(GlossyBounces, TheSkyIsSeenInAMirrorThatIsSeenInAMirror) {
  constexpr float kColour = 0.8f;
  Scene scene;
  const int mirror = test::addMaterial(scene, vec3(kColour), 1.0f, 0.0f);
  const int other = test::addMaterial(scene, vec3(kColour), 1.0f, 0.0f);
  test::addMesh(scene, test::squareMesh(4.0f, mirror));
  const NodeId wall = test::addMesh(scene, test::squareMesh(4.0f, other), vec3(2, 2, 0));
  scene.find(wall)->local.rotation = glm::angleAxis(0.5f * kPi, vec3(0, 0, 1));
  scene.sky = Sky::gradient(vec3(9.0f), vec3(1.0f), vec3(0.0f));
  const View view = test::lookAt(vec3(0.5f, 1.2f, 0), vec3(1.5f, 0, 0), 8, 8, 0.01f);
  const vec3 back = glm::normalize(vec3(-1.0f, 1.2f, 0));
  const auto fresnel = [](float cosine) {
    return kColour + (1.0f - kColour) * std::pow(1.0f - cosine, 5.0f);
  };
  const float sky = scene.sky.radianceFrom(back).g;
  const float expected = fresnel(back.y) * fresnel(-back.x) * sky;
  const float seen = test::meanOf(glossyPicture(scene, view, 256, glossyPaths(2))).g;
  EXPECT_NEAR(seen / expected, 1.0f, 5e-3f);
  // The second mirror is Lambertian without, and black if the path ends there.
  const float matt = test::meanOf(glossyPicture(scene, view, 256, glossyPaths(2, false))).g;
  EXPECT_GT(std::abs(matt / expected - 1.0f), 0.1f);
  EXPECT_LT(test::meanOf(glossyPicture(scene, view, 4, glossyPaths(0))).g, 0.01f * expected);
}

// A box in a room with a lamp and a sky.
Scene roomWithBox(float metallic, float roughness) {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.6f, 0.5f, 0.4f));
  test::addMesh(scene, test::squareMesh(6.0f, grey));
  const int box = test::addMaterial(scene, vec3(0.6f, 0.5f, 0.4f), metallic, roughness);
  test::addMesh(scene, test::boxMesh(vec3(1.0f), box), vec3(0.3f, 0.5f, 0.0f));
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(8.0f));
  scene.sky = Sky::gradient(vec3(0.2f, 0.3f, 0.4f), vec3(0.5f), vec3(0.1f));
  return scene;
}

TEST(GlossyBounces, WithoutGlossNoBitChanges) {
  const View view = test::lookAt(vec3(2, 2.5f, 4), vec3(0, 0.5f, 0), 37, 23);
  const Scene matt = roomWithBox(0.0f, 1.0f);
  EXPECT_TRUE(test::sameBits(glossyPicture(matt, view, 4, glossyPaths(3)),
                             glossyPicture(matt, view, 4, glossyPaths(3, false))));
  const Scene metal = roomWithBox(1.0f, 0.3f);
  EXPECT_FALSE(test::sameBits(glossyPicture(metal, view, 4, glossyPaths(3)),
                              glossyPicture(metal, view, 4, glossyPaths(3, false))));
}

}  // namespace
}  // namespace lamplighter
