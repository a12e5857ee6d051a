// The rasterised G-buffer against a ray a pixel.
#include "renderer/backends/cpu/gbuffer.h"

#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/scene/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

struct World {
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  explicit World(const Scene& scene) {
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
  }
};

// Pixels that show something else than a ray through their middle meets.
int pixelsThatDiffer(const World& w, const View& view, vec2 jitter) {
  cpu::GBuffer g;
  cpu::renderGBuffer(w.render, *w.rays, view, jitter, g);
  int differ = 0;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      Ray ray{view.eye, 0.0f,
              view.rayDirection(static_cast<float>(x) + 0.5f + jitter.x,
                                static_cast<float>(y) + 0.5f + jitter.y)};
      ray.tNear = view.znear / glm::dot(ray.direction, view.forward());
      const Hit hit = w.rays->intersect(ray, Surfaces::seen);
      const size_t i = g.index(x, y);
      if (!hit || g.hit[i] == 0) {
        differ += (g.hit[i] != 0) != static_cast<bool>(hit);
        continue;
      }
      const Surface s = surfaceAt(w.render, hit.object, hit.triangle, hit.u, hit.v);
      const vec3 position(g.px[i], g.py[i], g.pz[i]), normal(g.sx[i], g.sy[i], g.sz[i]);
      const float side = glm::dot(ray.direction, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
      const bool isSame =
          glm::distance(position, s.position) < 1e-3f * hit.t &&
          glm::distance(normal, side * s.normal) < 1e-2f &&
          glm::distance(g.albedo(i), s.albedo) < 1e-2f &&
          (g.object[i] == hit.object || glm::distance(position, s.position) < 1e-5f);
      differ += !isSame;
    }
  }
  return differ;
}

struct Case {
  const char* scene;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class RasterisedGBuffer : public testing::TestWithParam<Case> {};

// But for rays along edges, and where surfaces lie within each other.
TEST_P(RasterisedGBuffer, ShowsWhatRaysMeet) {
  const std::string name = GetParam().scene;
  const fs::path path = name.find('/') == std::string::npos
                            ? fs::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes" / name
                            : test::sharedScenes() / name;
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const World world(scene);
  std::vector<View> views{viewOfBounds(world.render.bounds, 117, 75)};
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) views.push_back(viewOfCamera(scene, node, 117, 75));
  // From within, with triangles all about the eye.
  const vec3 middle = world.render.bounds.centre();
  views.push_back(test::lookAt(middle, middle + vec3(0.3f, -0.4f, 1.0f), 117, 75, 1.9f));
  for (const View& view : views)
    EXPECT_LE(pixelsThatDiffer(world, view, vec2(0.3f, -0.2f)), view.width * view.height / 500);
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, RasterisedGBuffer,
    testing::Values(Case{"default.gltf"}, Case{"pillar_room.gltf"}, Case{"area_light_room.gltf"},
                    Case{"table_room.gltf"}, Case{"kenney-fps-level/kenney-fps-level.gltf"},
                    Case{"flight-helmet/FlightHelmet.gltf"}, Case{"bathroom/bathroom.glb"},
                    Case{"classroom/classroom.gltf"}, Case{"modern-hall/modern-hall.glb"}));

// A closed box of many triangles about the eye lets no ray pass between them.
TEST(RasterisedGBuffer, IsTightAtSharedEdges) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(1.0f, 24, 0.2f, test::addMaterial(scene, vec3(0.5f))));
  scene.materials[0].doubleSided = true;
  const World world(scene);
  for (int i = 0; i < 6; ++i) {
    const float a = 1.05f * static_cast<float>(i);
    cpu::GBuffer g;
    const View view = test::lookAt(vec3(0.1f, 0.05f, -0.07f), vec3(std::cos(a), 0.4f, std::sin(a)),
                                   200, 150, 1.8f);
    cpu::renderGBuffer(world.render, *world.rays, view, vec2(0.0f), g);
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) ASSERT_EQ(g.hit[g.index(x, y)], 1) << x << ", " << y;
  }
}

}  // namespace
}  // namespace lamplighter
