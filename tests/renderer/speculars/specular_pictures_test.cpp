// Speculars in whole pictures, against the path tracer and against closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Image render(const Scene& scene, const View& view, const std::string& method,
             const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  for (int frame = 0; frame < 1000; ++frame, changes = {}) {
    const GiOutput out = renderer.render({scene, changes, view, method, settings});
    if (out.settled) return out.radiance->pixels();
  }
  ADD_FAILURE() << "not settled";
  return {};
}

Image reference(const Scene& scene, const View& view, int paths, int bounces) {
  Settings s;
  s.set("samples_per_pixel", paths);
  s.set("samples_per_frame", paths);
  s.set("bounces", bounces);
  return render(scene, view, "reference", s);
}

Image manyLights(const Scene& scene, const View& view, int vpls, int bounces) {
  Settings s;
  s.set("vpls", vpls);
  s.set("updates", vpls);
  s.set("bounces", bounces);
  s.set("antialias", 1);
  s.set("clamp_distance", 0.05f);
  return render(scene, view, "many_lights", s);
}

// Seen at normal incidence below a constant sky of radiance 1: a smooth metal reflects its colour,
// a smooth dielectric its diffuse colour plus 4%, and a rough dielectric its colour.
TEST(SpecularPictures, AFloorUnderAConstantSkyReflectsItsAlbedo) {
  const auto mean = [](float metallic, float roughness) {
    Scene scene;
    test::addMesh(
        scene, test::squareMesh(20.0f, test::addMaterial(scene, vec3(0.6f), metallic, roughness)));
    scene.sky = vec3(1.0f);
    const View above = test::lookAt(vec3(0.2f, 5, 0.1f), vec3(0), 12, 12, 0.05f);
    return test::meanOf(reference(scene, above, 256, 1)).g;
  };
  EXPECT_NEAR(mean(1.0f, 0.2f), 0.6f, 0.01f);
  EXPECT_NEAR(mean(0.0f, 0.2f), 0.6f * 0.96f + 0.04f, 0.01f);
  EXPECT_NEAR(mean(0.0f, 1.0f), 0.6f, 0.01f);
}

// A glossy floor that reflects an area light.
Scene glossyFloor(float metallic, float roughness) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(8.0f, test::addMaterial(scene, vec3(0.5f, 0.4f, 0.3f),
                                                                metallic, roughness)));
  const NodeId light =
      test::addRectangleLight(scene, vec3(0, 1.2f, -1.5f), vec2(1.2f, 0.8f), vec3(6, 5, 4));
  scene.find(light)->local.rotation = glm::angleAxis(kPi, vec3(0, 1, 0));  // towards +Z, the eye
  return scene;
}
const View kFloorView = test::lookAt(vec3(0.2f, 1.1f, 2.5f), vec3(0, 0, -0.2f), 48, 36, 0.7f);

// The error in the lower half of the picture, which shows only the floor.
double error(const Scene& scene, const Image& reference, int vpls) {
  const Image image = manyLights(scene, kFloorView, vpls, 0);
  double sum = 0.0, squares = 0.0;
  for (size_t i = image.pixels.size() / 2; i < image.pixels.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(image.pixels[i]) - glm::dvec3(reference.pixels[i]);
    squares += glm::dot(d, d);
    sum += glm::dot(glm::dvec3(reference.pixels[i]), glm::dvec3(reference.pixels[i]));
  }
  return std::sqrt(squares / sum);
}

TEST(SpecularPictures, AGlossyFloorConvergesToTheReference) {
  for (const float metallic : {0.0f, 1.0f}) {
    const Scene scene = glossyFloor(metallic, 0.35f);
    const Image truth = reference(scene, kFloorView, 256, 0);
    const double few = error(scene, truth, 16), more = error(scene, truth, 64),
                 many = error(scene, truth, 1024);

    std::printf("metallic %.0f: 16 %.4f, 64 %.4f, 1024 %.4f\n", metallic, few, more, many);
    EXPECT_LT(more, few);
    EXPECT_LT(many, more);
    EXPECT_LT(many, 0.03);
  }
}

float brightestOfFloor(const Image& image) {
  float most = 0.0f;
  for (size_t i = image.pixels.size() / 2; i < image.pixels.size(); ++i)
    most = std::max(most, image.pixels[i].r);
  return most;
}

// For any number of VPLs, none of their highlights is brighter than the mirror image of the light.
TEST(SpecularPictures, NoLightSampleIsVisibleAsASpot) {
  const Scene scene = glossyFloor(1.0f, 0.1f);
  const float mirrored = brightestOfFloor(reference(scene, kFloorView, 64, 0));
  for (const int vpls : {1, 4, 16, 64}) {
    const float most = brightestOfFloor(manyLights(scene, kFloorView, vpls, 0));
    std::printf("%d: %.3f of %.3f\n", vpls, most, mirrored);
    EXPECT_LT(most, 1.3f * mirrored) << vpls;
    EXPECT_GT(most, 0.1f * mirrored) << vpls;
  }
}

// A room with one window: transparent panes do not change the light.
TEST(SpecularPictures, GlazedWindowsLetLightIn) {
  enum class Pane { none, glass, wood };
  const auto room = [](Pane pane) {
    Scene scene;
    Node& sun = scene.nodes.emplace_back();
    sun.id = scene.nextId++;
    sun.punctual = PunctualLight{PunctualKind::directional, vec3(3.0f)};
    sun.local.rotation = glm::angleAxis(-0.6f, vec3(1, 0, 0));
    const int white = test::addMaterial(scene, vec3(0.7f));
    test::addMesh(scene, test::squareMesh(4.0f, white));
    test::addMesh(scene, test::boxMesh(vec3(4, 1, 0.2f), white), vec3(0, 0.5f, 2));
    test::addMesh(scene, test::boxMesh(vec3(4, 3, 0.2f), white), vec3(0, 3.5f, 2));
    if (pane != Pane::none) {
      const int glass = test::addMaterial(scene, vec3(0.7f), 0.0f, 0.0f);
      scene.materials[static_cast<size_t>(glass)].transmission = pane == Pane::glass ? 1.0f : 0.0f;
      test::addMesh(scene, test::boxMesh(vec3(4, 1, 0.02f), glass), vec3(0, 1.5f, 2));
    }
    return scene;
  };
  const View view = test::lookAt(vec3(0.5f, 3, -1.5f), vec3(0, 0, 0.2f), 32, 24, 0.9f);
  for (const std::string method : {"many_lights", "reference"}) {
    const auto picture = [&](Pane pane) {
      return method == "reference" ? reference(room(pane), view, 16, 1)
                                   : manyLights(room(pane), view, 64, 1);
    };
    const Image glazed = picture(Pane::glass);
    // The tiles of the sun also cover the panes, so the light samples differ slightly.
    const double difference = compareImages(glazed, picture(Pane::none)).relRmse;
    std::printf("%s: %.5f\n", method.c_str(), difference);
    EXPECT_LE(difference, method == "reference" ? 0.0 : 0.03) << method;
    std::printf("%s: %.3f, shut %.3f\n", method.c_str(), test::meanOf(glazed).g,
                test::meanOf(picture(Pane::wood)).g);
    EXPECT_GT(test::meanOf(glazed).g, 2.0f * test::meanOf(picture(Pane::wood)).g) << method;
  }
}

}  // namespace
}  // namespace lamplighter
