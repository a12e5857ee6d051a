// The links of a point: where its bounced light comes from.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "renderer/methods/mesh_senders.h"
#include "renderer/scene/surface.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A room with a red box, and a sphere of triangles that are smaller than elements.
struct LinkedRoom {
  Scene scene;
  NodeId box = kNoNode;
  View view = test::lookAt(vec3(1.4f, 0.7f, 1.9f), vec3(0.0f, -0.6f, 0.0f), 64, 48);
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};

  LinkedRoom() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    const int red = test::addMaterial(scene, vec3(0.8f, 0.2f, 0.1f));
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(0.0f, -1.1f, 0.0f));
    test::addMesh(scene, test::sphereMesh(0.3f, 40, 0.1f, white), vec3(-1.0f, -1.0f, 0.5f));
    test::addRectangleLight(scene, vec3(-0.6f, 1.3f, 0.0f), vec2(0.8f), vec3(5.0f));
    settings.set("bounces", 2);
    settings.set("texel", 0.4f);
    settings.set("antialias", 1);
  }

  // Incident bounced light: E / π.
  GiOutput frame(const std::string& method, const SceneChanges& changes) {
    return renderer.render({.scene = scene,
                            .changes = changes,
                            .view = view,
                            .method = method,
                            .settings = settings,
                            .lightOnly = true,
                            .part = LightPart::indirect});
  }
  GiOutput settle(const std::string& method, SceneChanges changes = SceneChanges::all()) {
    GiOutput out;
    for (int i = 0; i < 3000 && !out.settled; ++i) {
      out = frame(method, changes);
      changes = {};
    }
    EXPECT_TRUE(out.settled);
    return out;
  }
  // The place that a pixel shows.
  std::optional<InspectedPlace> placeAt(int x, int y) const {
    const vec3 d = view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const Hit hit = renderer.rays()->intersect({view.eye, 0.0f, d}, Surfaces::seen);
    if (!hit) return std::nullopt;
    return InspectedPlace{
        hit.object,
        hit.triangle,
        isOnBack(renderer.scene(), hit, d),
        {hit.u, hit.v},
        surfaceAt(renderer.scene(), hit.object, hit.triangle, hit.u, hit.v).position};
  }
};

vec3 sumOf(const std::vector<InspectedLink>& links) {
  glm::dvec3 sum(0.0);
  for (const InspectedLink& link : links) sum += glm::dvec3(link.irradiance);
  return vec3(sum);
}

bool isIn(const Bounds& box, const vec3& p) {
  const vec3 slack(1e-4f);
  return glm::all(glm::greaterThan(p, box.min - slack)) &&
         glm::all(glm::lessThan(p, box.max + slack));
}

// Within 1e-5 of the strongest channel.
void expectSame(const vec3& a, const vec3& b) {
  const float most = std::max({b.r, b.g, b.b});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f * most);
}

TEST(InspectedLinks, OfTexelsSumToTheBouncedLightOfThePicture) {
  for (const std::string method : {"many_lights", "surface_shadow_maps"}) {
    SCOPED_TRACE(method);
    LinkedRoom room;
    room.settings.set("indirect", std::string("links"));
    GiOutput out = room.settle(method);
    // The object takes its texels with it.
    const Scene old = room.scene;
    room.scene.find(room.box)->local.translation.z += 0.3f;
    out = room.settle(method, compare(old, room.scene));
    const Image& picture = out.radiance->pixels();
    const Inspection inspection = room.renderer.inspect();
    ASSERT_TRUE(inspection.has(Capability::links));
    int tested = 0;
    for (int y = 3; y < 48; y += 9) {
      for (int x = 2; x < 64; x += 11) {
        const auto place = room.placeAt(x, y);
        if (!place) continue;
        const auto links = inspection.links(*place);
        ASSERT_TRUE(links);
        const vec3 shown = kPi * picture.at(x, y);
        if (shown == vec3(0.0f)) continue;
        expectSame(sumOf(*links), shown);
        ++tested;
        for (const InspectedLink& link : *links) {
          EXPECT_EQ(link.from, place->position);
          EXPECT_GT(link.size, 0.0f);
          EXPECT_TRUE(isIn(room.renderer.scene().bounds, link.to));
        }
      }
    }
    EXPECT_GT(tested, 15);
  }
}

TEST(InspectedLinks, OfMeshesSumToTheLightThatTheyKeep) {
  for (const std::string method : {"many_lights", "multi_mesh"}) {
    SCOPED_TRACE(method);
    LinkedRoom room;
    room.settings.set("indirect", std::string("meshes"));
    room.settle(method);
    const Inspection inspection = room.renderer.inspect();
    ASSERT_TRUE(inspection.has(Capability::links));
    int tested = 0;
    for (int y = 3; y < 48; y += 9) {
      for (int x = 2; x < 64; x += 11) {
        const auto place = room.placeAt(x, y);
        if (!place) continue;
        const auto element = inspection.elements->placeAt(place->object, place->triangle,
                                                          place->isBack, place->weights);
        if (!element || element->isCluster) continue;
        const auto corners = inspection.elements->cornersOf(element->element);
        vec3 kept(0.0f);
        for (size_t c = 0; c < 3; ++c)
          kept += element->weights[static_cast<int>(c)] * corners[c].irradiance;
        expectSame(sumOf(*inspection.links(*place)), kept);
        ++tested;
      }
    }
    EXPECT_GT(tested, 15);
  }
}

// Also where small triangles blend samples, where objects bury samples, and while rays are missing.
TEST(InspectedLinks, OfMeshesSumToEachValue) {
  const LinkedRoom room;
  const RenderScene scene = test::renderSceneOf(room.scene);
  const RayCaster rays(scene);
  SurfaceLight light;
  RenderSceneChanges changes = test::everythingRebuilt();
  SurfaceLightOptions options;
  options.edge = 0.3f;
  int buried = 0, blended = 0;
  for (int frame = 0; frame < 2; ++frame) {
    if (!light.update(scene, changes, rays, options, frame == 0 ? 1 : SurfaceLight::kAllRays))
      continue;
    changes = {};
    for (uint32_t object = 0; object < scene.objects.size(); ++object) {
      const uint32_t triangles = scene.objects[object].triangleCount();
      // Many places on large triangles, one on some of the small ones.
      const uint32_t step = 1 + triangles / 40, places = triangles > 40 ? 1 : 12;
      for (uint32_t k = 0; k < places * places * triangles; k += step) {
        const vec2 grid(static_cast<float>(k / triangles % places) + 0.4f,
                        static_cast<float>(k / triangles / places) + 0.3f);
        const InspectedPlace place{object, k % triangles, false,
                                   grid / static_cast<float>(2 * places), vec3(0.0f)};
        MeshPoint point;
        if (!light.mesh().find(scene, object, place.triangle, false, place.weights, point))
          continue;
        vec3 value(0.0f);
        for (size_t c = 0; c < 3; ++c) {
          value += point.weights[static_cast<int>(c)] * light.values()[point.values[c]];
          const bool isSample = point.values[c] < light.mesh().samples();
          blended += isSample ? 0 : 1;
          buried += isSample && light.isBuried(point.values[c]) ? 1 : 0;
        }
        expectSame(sumOf(meshSendersTo(scene, light, place)), value);
      }
    }
  }
  EXPECT_GT(buried, 0);
  EXPECT_GT(blended, 0);
}

// A white plate under a spot in a black room.
TEST(InspectedLinks, LeadToTheSurfaceThatReflects) {
  Scene scene;
  const int black = test::addMaterial(scene, vec3(0.0f)),
            white = test::addMaterial(scene, vec3(0.8f));
  test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), black));
  test::addMesh(scene, test::boxMesh(vec3(1.0f, 0.1f, 1.0f), white), vec3(0.8f, -1.4f, 0.0f));
  test::addRectangleLight(scene, vec3(0.5f, 1.3f, 0.0f), vec2(0.5f), vec3(5.0f));
  const View view = test::lookAt(vec3(0.0f), vec3(2.0f, -0.5f, 0.0f), 16, 12);
  for (const std::string indirect : {"links", "meshes"}) {
    SCOPED_TRACE(indirect);
    Settings settings;
    settings.set("indirect", indirect);
    settings.set("bounces", 1);
    FrameRenderer renderer(makeCpuBackend());
    test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
    const Hit hit = renderer.rays()->intersect({vec3(0.0f), 0.0f, vec3(1.0f, 0.02f, 0.03f)});
    const auto links = renderer.inspect().links(
        {hit.object, hit.triangle, false, {hit.u, hit.v}, hit.t * vec3(1.0f, 0.02f, 0.03f)});
    ASSERT_TRUE(links);
    EXPECT_GT(sumOf(*links).r, 0.002f);
    for (const InspectedLink& link : *links) {
      EXPECT_EQ(link.object, 1u);
      EXPECT_TRUE(isIn(renderer.scene().objects[1].bounds, link.to));
    }
  }
}

TEST(InspectedLinks, AreNotKnownBeforeTheyAreFound) {
  LinkedRoom room;
  room.settings.set("indirect", std::string("samples"));
  room.frame("many_lights", SceneChanges::all());
  EXPECT_FALSE(room.renderer.inspect().has(Capability::links));
  room.settings.set("indirect", std::string("links"));
  room.settings.set("texel", 0.2f);
  room.settings.set("updates", 1);
  GiOutput out = room.frame("many_lights", {});
  ASSERT_LT(out.stats.of("prepared"), 100.0);
  const auto texts = statusTexts(out.stats.declared);
  EXPECT_TRUE(std::ranges::any_of(texts, [](const StatusText& text) {
    return text.isPending && text.text.starts_with("finding links ") && text.text.ends_with("%");
  }));
  const InspectedPlace place = room.placeAt(40, 40).value();
  EXPECT_FALSE(room.renderer.inspect().links(place));
  room.settings.reset("updates");
  room.settle("many_lights", {});
  EXPECT_TRUE(room.renderer.inspect().links(place));
}

}  // namespace
}  // namespace lamplighter
