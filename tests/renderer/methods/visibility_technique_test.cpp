// The techniques `visibility` and `light_maps` give the picture of `naive` with fewer look-ups, and
// edits leave no trace in it.
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/gltf_io.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/lit_scene.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 192, kHeight = 128;

Settings settingsOf(const std::string& technique, int vpls) {
  Settings s;
  s.set(parameters::technique().name, technique);
  s.set(parameters::vpls().name, vpls);
  s.set(parameters::updates().name, 150);
  s.set(parameters::antialias().name, 1);
  return s;
}

View viewOf(const Scene& scene) {
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) return viewOfCamera(scene, node, kWidth, kHeight);
  RenderScene render;
  update(render, scene, SceneChanges::all());
  return viewOfBounds(render.bounds, kWidth, kHeight);
}

struct Rendered {
  Image image;
  uint64_t lookUps;
};

Rendered rendered(const Scene& scene, const View& view, const std::string& technique, int vpls) {
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput out =
      test::renderSettled(renderer, scene, SceneChanges::all(), view, settingsOf(technique, vpls));
  return {out.radiance->pixels(), renderer.backend().counts().lookUps};
}

// What both should be: the same VPLs with a ray for each shadow.
Image withRays(const Scene& scene, const View& view, int vpls) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  const RayCaster rays(render);
  const Settings settings = settingsOf("naive", vpls);
  const VplCounts counts{vpls, settings.real(parameters::directShare()),
                         settings.integer(parameters::bounces()),
                         static_cast<uint32_t>(settings.integer(parameters::seed()))};
  const auto lights = generateVpls(render, rays, LightSet(render), counts).vpls;
  const auto radiance = [&](int x, int y) {
    const Ray ray{view.eye, 0.0f,
                  view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
    const Hit hit = rays.intersect(ray, Surfaces::seen);
    if (!hit) return render.sky;
    const Surface s = surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v);
    const bool front = glm::dot(ray.direction, s.geometricNormal) < 0.0f;
    const vec3 ng = front ? s.geometricNormal : -s.geometricNormal;
    const vec3 start = s.position + rayEpsilon(s.position) * ng;
    vec3 e(0.0f);
    for (const SceneVpl& light : lights) {
      const shared::Vpl& vpl = light.vpl;
      const float g = shared::vplGeometry(vpl, s.position, front ? s.normal : -s.normal, ng,
                                          settings.real(parameters::clampDistance()));
      if (g == 0.0f) continue;
      const vec3 axis(vpl.normal), at(vpl.position);
      const bool parallel = vpl.position.w == shared::kVplDirectional;
      const vec3 way = parallel ? axis : at + 2.0f * rayEpsilon(at) * axis - start;
      if (!rays.occluded(parallel ? Ray{start, 0.0f, way} : Ray{start, 0.0f, way, 1.0f}))
        e += g * vec3(vpl.intensity);
    }
    return (front || s.emitsBothSides ? s.emission : vec3(0.0f)) + s.albedo / kPi * e;
  };
  Image image(view.width, view.height);
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) image.at(x, y) = radiance(x, y);
  });
  return image;
}

struct Case {
  const char* scene;
  int vpls;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class VisibilityTechnique : public testing::TestWithParam<Case> {};

// Within 1%. Where a level's shadow maps leak by more than that, the techniques that know that
// nothing or all of a light arrives are farther from `naive`, but then nearer to what is right.
TEST_P(VisibilityTechnique, IsThePictureOfNaive) {
  const std::string name = GetParam().scene;
  const fs::path path = name.find('/') == std::string::npos
                            ? fs::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes" / name
                            : test::sharedScenes() / name;
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const View view = viewOf(scene);
  const Rendered naive = rendered(scene, view, "naive", GetParam().vpls);
  for (const std::string technique : {"visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    const Rendered fast = rendered(scene, view, technique, GetParam().vpls);
    const Metrics m = compareImages(fast.image, naive.image);
    RecordProperty(technique + "RelRmse", std::to_string(m.relRmse));
    RecordProperty(technique + "LookUpsPercent",
                   std::to_string(100 * fast.lookUps / naive.lookUps));
    EXPECT_LT(fast.lookUps, naive.lookUps);
    EXPECT_NEAR(m.bias, 1.0, 0.005);
    if (m.relRmse < 0.01) continue;
    const Image truth = withRays(scene, view, GetParam().vpls);
    EXPECT_LT(compareImages(fast.image, truth).relRmse, compareImages(naive.image, truth).relRmse)
        << "and " << m.relRmse << " from naive";
  }
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, VisibilityTechnique,
    testing::Values(Case{"default.gltf", 300}, Case{"area_light_room.gltf", 300},
                    Case{"table_room.gltf", 300}, Case{"pillar_room.gltf", 300},
                    Case{"cornell_style.gltf", 300}, Case{"modern-hall/modern-hall.glb", 100},
                    Case{"bathroom/bathroom.glb", 100}, Case{"zdm2-map/zdm2.glb", 20},
                    Case{"classroom/classroom.gltf", 300},
                    Case{"kenney-fps-level/kenney-fps-level.gltf", 100},
                    Case{"flight-helmet/FlightHelmet.gltf", 100}));

TEST(VisibilityTechnique, APictureAfterEditsIsTheOneMadeFromNothing) {
  Scene scene = loadGltf(fs::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes/pillar_room.gltf").scene;
  const View view = viewOf(scene);
  FrameRenderer renderer(makeCpuBackend());
  const Settings settings = settingsOf("visibility", 120);
  test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
  for (Node& node : scene.nodes) {
    if (node.name != "mover" && node.name != "ceiling light") continue;
    const Scene before = scene;
    node.local.translation += vec3(0.7f, 0.0f, 0.3f);
    test::renderSettled(renderer, scene, compare(before, scene), view, settings);
  }
  const Image edited = test::renderSettled(renderer, scene, {}, view, settings).radiance->pixels();
  EXPECT_TRUE(test::sameBits(edited, rendered(scene, view, "visibility", 120).image));
}

}  // namespace
}  // namespace lamplighter
