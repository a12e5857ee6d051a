// The rasterised G-buffer against one ray per pixel.
#include "renderer/backends/cpu/gbuffer/gbuffer.h"

#include <array>
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

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

// Counts the pixels whose surface differs from what a ray through the pixel's centre hits.
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

// Exceptions: rays along edges, and surfaces that coincide.
TEST_P(RasterisedGBuffer, EqualsRayHits) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const World world(scene);
  std::vector<View> views{viewOfBounds(world.render.bounds, 117, 75)};
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) views.push_back(viewOfCamera(scene, node, 117, 75));
  // From inside the scene, with triangles on all sides of the eye.
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

// Inside a closed mesh of many triangles, no ray passes between them.
TEST(RasterisedGBuffer, HasNoGapsAtSharedEdges) {
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

// Compares the visible surfaces and the flags of packets and tiles.
void expectSame(const cpu::GBuffer& a, const cpu::GBuffer& b) {
  ASSERT_EQ(a.hit, b.hit);
  EXPECT_EQ(a.isFlat, b.isFlat);
  EXPECT_EQ(a.packetTriangle, b.packetTriangle);
  EXPECT_EQ(a.onlyTriangle, b.onlyTriangle);
  int differ = 0;
  for (size_t i = 0; i < a.hit.size(); ++i) {
    if (a.hit[i] == 0) continue;
    const auto at = [i](const cpu::GBuffer& g) {
      return std::array{g.px[i], g.py[i], g.pz[i], g.sx[i], g.sy[i], g.sz[i], g.gx[i], g.gy[i],
                        g.gz[i], g.ar[i], g.ag[i], g.ab[i], g.er[i], g.eg[i], g.eb[i]};
    };
    differ += at(a) != at(b) || a.object[i] != b.object[i] || a.triangle[i] != b.triangle[i];
  }
  EXPECT_EQ(differ, 0);
}

// Packets that are marked as one flat triangle really show only that triangle.
void expectOneTriangleEach(const cpu::GBuffer& g, int least) {
  int packets = 0;
  for (size_t i = 0; i < g.hit.size(); ++i) {
    const size_t first = i / cpu::kLanes * cpu::kLanes;
    const uint64_t of = g.packetTriangle[first / cpu::kLanes];
    const uint64_t only = g.onlyTriangle[i / cpu::kTilePixels];
    ASSERT_TRUE(only == cpu::GBuffer::kMany || only == of);
    if (of == cpu::GBuffer::kMany) continue;
    packets += i == first;
    ASSERT_EQ(g.hit[i], 1);
    ASSERT_EQ(of, uint64_t{g.object[i]} << 32 | g.triangle[i]);
    ASSERT_EQ(g.isFlat[first / cpu::kLanes], 1);
    ASSERT_EQ(g.albedo(i), g.albedo(first));
    ASSERT_EQ(vec3(g.gx[i], g.gy[i], g.gz[i]), vec3(g.gx[first], g.gy[first], g.gz[first]));
  }
  EXPECT_GT(packets, least);
}

// Buffers are reused between frames. Parts that are not rewritten must not keep data of an earlier
// view or of earlier materials.
TEST(RasterisedGBuffer, ReusingABufferEqualsANewOne) {
  Scene scene = test::loadAsset("table_room");
  constexpr int kWidth = 203, kHeight = 150;
  cpu::GBuffer kept;
  const auto look = [&](const View& view) {
    const World world(scene);
    cpu::renderGBuffer(world.render, *world.rays, view, vec2(0.0f), kept);
    cpu::GBuffer fresh;
    cpu::renderGBuffer(world.render, *world.rays, view, vec2(0.0f), fresh);
    expectSame(kept, fresh);
    expectOneTriangleEach(kept, kWidth * kHeight / cpu::kLanes / 3);
  };
  View view = test::viewOf(scene, kWidth, kHeight);
  look(view);
  view.eye += vec3(0.002f, 0.001f, 0.0f);
  look(view);
  for (Material& m : scene.materials) m.baseColor = vec4(0.9f, 0.1f, 0.2f, 1.0f);
  look(view);
  for (Node& node : scene.nodes)
    if (node.mesh != kNone) node.local.translation.y += 0.03f;
  look(view);
  view.eye.x += 0.7f;
  look(view);
  scene.materials[0].emissive = vec3(2.0f);
  look(view);
}

}  // namespace
}  // namespace lamplighter
