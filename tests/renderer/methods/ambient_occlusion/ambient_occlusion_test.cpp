// Ambient occlusion against closed forms.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/threads.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr float kEverywhere = 1000.0f;  // larger than all distances [m]

Settings settingsOf(float radius, const std::string& falloff, int samples = 256) {
  Settings settings;
  settings.set("radius", radius);
  settings.set("falloff", falloff);
  settings.set("samples_per_pixel", samples);
  settings.set("samples_per_frame", samples);
  return settings;
}

GiOutput settled(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                 const View& view, const Settings& settings, bool lightOnly = true) {
  GiOutput out;
  SceneChanges seen = changes;
  do {
    out = renderer.render({scene, seen, view, "ambient_occlusion", settings, lightOnly});
    seen = {};
  } while (!out.settled);
  return out;
}

Image pictureOf(const Scene& scene, const View& view, const Settings& settings,
                bool lightOnly = true) {
  FrameRenderer renderer(makeCpuBackend());
  return settled(renderer, scene, SceneChanges::all(), view, settings, lightOnly)
      .radiance->pixels();
}

// The accessibility of a small part of the floor at x, seen from above at an angle.
float accessibilityAt(const Scene& scene, const vec3& x, const Settings& settings) {
  const View view = test::lookAt(x + vec3(0.3f, 1.0f, 0.4f), x, 8, 8, 0.005f);
  return test::meanOf(pictureOf(scene, view, settings)).g;
}

Scene floorOf(float size) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(size, test::addMaterial(scene, vec3(0.5f))));
  return scene;
}

// A room with a box and a sphere.
Scene room() {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.6f, 0.4f, 0.2f));
  test::addMesh(scene, test::roomMesh(vec3(5, 3, 5), grey), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), grey), vec3(-0.7f, 0.5f, 0));
  test::addMesh(scene, test::sphereMesh(0.4f, 10, 0.0f, grey), vec3(0.8f, 0.4f, 0.5f));
  return scene;
}
const View kRoomView = test::lookAt(vec3(0.5f, 1.6f, 2.3f), vec3(0, 0.8f, 0), 48, 32, 1.1f);

TEST(AmbientOcclusion, AnOpenPlaneIsFullyAccessible) {
  EXPECT_EQ(accessibilityAt(floorOf(10.0f), vec3(0), settingsOf(kEverywhere, "none")), 1.0f);
}

TEST(AmbientOcclusion, AConvexBodyIsFullyAccessibleForAnyNormals) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(1.0f, 8), vec3(0));
  const View view = test::lookAt(vec3(0, 0, 5), vec3(0), 16, 16, 0.2f);
  for (const vec3& p : pictureOf(scene, view, settingsOf(kEverywhere, "none", 16)).pixels)
    EXPECT_NEAR(p.g, 1.0f, 1e-6f);
}

// The form factor from a point to an infinitely long wall of height h at distance d, perpendicular
// to the floor: 1/2 (1 − d / √(d² + h²)). In the corner it is 1/2.
TEST(AmbientOcclusion, BesideAWallItIsOneMinusTheFormFactorOfTheWall) {
  constexpr float kHeight = 2.0f;
  Scene scene = floorOf(400.0f);
  test::addMesh(scene, test::boxMesh(vec3(400.0f, kHeight, 0.5f)), vec3(0, 0.5f * kHeight, -0.25f));
  for (const float d : {0.02f, 0.5f, 1.0f, 3.0f}) {
    const float wall = 0.5f * (1.0f - d / std::sqrt(d * d + kHeight * kHeight));
    EXPECT_NEAR(accessibilityAt(scene, vec3(0, 0, d), settingsOf(kEverywhere, "none", 1024)),
                1.0f - wall, 4e-3f)
        << d;
  }
}

TEST(AmbientOcclusion, UnderASquareItIsOneMinusTheFormFactorOfTheSquare) {
  Scene scene = floorOf(20.0f);
  test::addMesh(scene, test::boxMesh(vec3(2.0f, 0.2f, 2.0f)), vec3(0, 1.1f, 0));
  const std::vector<vec3> square{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}};
  const double f = test::polygonFormFactor(vec3(0), vec3(0, 1, 0), square);
  // From the side, below the square.
  const View view = test::lookAt(vec3(2.5f, 0.6f, 0.1f), vec3(0), 8, 8, 0.005f);
  const Settings settings = settingsOf(kEverywhere, "none", 1024);
  EXPECT_NEAR(test::meanOf(pictureOf(scene, view, settings)).g, 1.0 - f, 4e-3);
}

// Under an infinite ceiling at height h, with k = h / radius and μ = cos θ: the distance is h / μ,
// so A = 1 − ∫ 2 μ (1 − ρ(k / μ)) dμ for μ from k to 1.
TEST(AmbientOcclusion, TheFalloffsHaveTheirClosedFormsUnderACeiling) {
  Scene scene = floorOf(200.0f);
  test::addMesh(scene, test::boxMesh(vec3(200.0f, 0.2f, 200.0f)), vec3(0, 1.1f, 0));
  for (const float radius : {1.25f, 2.0f, 5.0f}) {
    const float k = 1.0f / radius, root = std::sqrt(k);
    const float blocked[] = {1 - k * k, (1 - k) * (1 - k),
                             1 - k * k - 4.0f / 3.0f * root * (1 - k * root)};
    const char* names[] = {"none", "linear", "root"};
    for (int i = 0; i < 3; ++i) {
      const View view = test::lookAt(vec3(0.9f, 0.7f, 0.3f), vec3(0), 8, 8, 0.005f);
      const Settings settings = settingsOf(radius, names[i], 1024);
      EXPECT_NEAR(test::meanOf(pictureOf(scene, view, settings)).g, 1.0f - blocked[i], 4e-3f)
          << names[i] << ' ' << radius;
    }
  }
}

TEST(AmbientOcclusion, InABoxSmallerThanTheRadiusNothingIsAccessible) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(2.0f)));
  const View view = test::lookAt(vec3(0), vec3(0, -0.3f, -1), 16, 16, 1.0f);
  for (const vec3& p : pictureOf(scene, view, settingsOf(4.0f, "none", 16)).pixels)
    EXPECT_EQ(p.g, 0.0f);
}

TEST(AmbientOcclusion, HolesOfAlphaMasksAndPanesBlockNothing) {
  for (const bool isPane : {false, true}) {
    Scene scene = floorOf(10.0f);
    const int material = test::addMaterial(scene, vec3(1.0f));
    Material& m = scene.materials[static_cast<size_t>(material)];
    if (isPane) {
      m.transmission = 1.0f;
    } else {
      m.alphaMode = AlphaMode::mask;
      m.baseColor.a = 0.0f;
    }
    test::addMesh(scene, test::boxMesh(vec3(4.0f, 0.1f, 4.0f), material), vec3(0, 2.0f, 0));
    EXPECT_EQ(accessibilityAt(scene, vec3(0), settingsOf(kEverywhere, "none", 64)), 1.0f);
  }
}

TEST(AmbientOcclusion, ThePictureIsAlbedoTimesAccessibility) {
  const Settings settings = settingsOf(2.0f, "root", 4);
  const Image white = pictureOf(room(), kRoomView, settings);
  const Image lit = pictureOf(room(), kRoomView, settings, false);
  for (size_t i = 0; i < lit.pixels.size(); ++i) {
    EXPECT_NEAR(lit.pixels[i].r, 0.6f * white.pixels[i].r, 1e-6f);
    EXPECT_NEAR(lit.pixels[i].b, 0.2f * white.pixels[i].b, 1e-6f);
  }
}

TEST(AmbientOcclusion, SameBitsAtAnyNumberOfThreadsAndFrames) {
  Settings settings = settingsOf(2.0f, "root", 12);
  const Image expected = pictureOf(room(), kRoomView, settings);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    for (const int aFrame : {1, 5, 12}) {
      settings.set("samples_per_frame", aFrame);
      EXPECT_TRUE(test::sameBits(pictureOf(room(), kRoomView, settings), expected));
    }
  }
}

TEST(AmbientOcclusion, AfterEditsThePictureEqualsAFreshRender) {
  Scene scene = room();
  View view = kRoomView;
  Settings settings = settingsOf(2.0f, "root", 6);
  settings.set("samples_per_frame", 4);
  FrameRenderer renderer(makeCpuBackend());
  settled(renderer, scene, SceneChanges::all(), view, settings);
  Scene before = scene;
  scene.nodes[1].local.translation += vec3(0.7f, 0.0f, 0.3f);
  renderer.render({scene, compare(before, scene), view, "ambient_occlusion", settings, true});
  before = scene;
  scene.nodes.pop_back();
  view.eye.x += 0.1f;
  settled(renderer, scene, compare(before, scene), view, settings);
  settings.set("samples_per_pixel", 3);  // fewer than already traced
  const Image edited = settled(renderer, scene, {}, view, settings).radiance->pixels();
  EXPECT_TRUE(test::sameBits(edited, pictureOf(scene, view, settings)));
}

TEST(AmbientOcclusion, CountsItsRaysAndDrawsItsView) {
  FrameRenderer renderer(makeCpuBackend());
  const Scene scene = room();
  Settings settings = settingsOf(2.0f, "none", 8);
  settings.set("samples_per_frame", 2);
  GiOutput out =
      renderer.render({scene, SceneChanges::all(), kRoomView, "ambient_occlusion", settings, true});
  EXPECT_EQ(out.stats.raysTraced, 2u * 48u * 32u);  // no pixel shows the sky
  EXPECT_EQ(out.stats.samplesPerPixel, 2);
  EXPECT_EQ(out.stats.framesUntilSettled, 3);
  EXPECT_FALSE(out.settled);
  out = settled(renderer, scene, {}, kRoomView, settings);
  EXPECT_EQ(out.stats.samplesPerPixel, 8);
  const ViewPicture view = renderer.inspect().pictures.at("accessibility")();
  EXPECT_EQ(view.legend.high, "1");
  const Image& picture = out.radiance->pixels();
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    EXPECT_NEAR(static_cast<float>(view.image.pixels[4 * i]), 255.0f * picture.pixels[i].g, 0.51f);
}

TEST(AmbientOcclusion, IndirectLightIsNone) {
  const Scene scene = room();
  FrameRenderer renderer(makeCpuBackend());
  const Settings settings = settingsOf(2.0f, "root", 2);
  const auto part = [&](LightPart which) {
    return renderer.render({scene, {}, kRoomView, "ambient_occlusion", settings, false, {}, which})
        .radiance->pixels();
  };
  settled(renderer, scene, SceneChanges::all(), kRoomView, settings, false);
  EXPECT_EQ(part(LightPart::direct).pixels, part(LightPart::all).pixels);
  EXPECT_EQ(luminance(test::meanOf(part(LightPart::indirect))), 0.0f);
}

}  // namespace
}  // namespace lamplighter
