// Light linking on both backends: the same pictures with and without patches, with speculars, and
// with the low-resolution pass.
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Variant {
  const char* technique;
  const char* block;
  bool speculars;
};
void PrintTo(const Variant& v, std::ostream* out) { *out << v.technique << v.block; }

class GlLinking : public test::GlTest, public testing::WithParamInterface<Variant> {};

TEST_P(GlLinking, LooksTheSameOnBothBackends) {
  Scene scene;
  const int gloss = test::addMaterial(scene, vec3(0.7f));
  scene.materials[0].roughness = 0.3f;
  const NodeId left = test::addMesh(scene, test::squareMesh(4.0f, gloss), vec3(-2, 0, 0));
  const NodeId strip = test::addMesh(scene, test::squareMesh(0.4f, gloss), vec3(0.5f, 0.01f, 0.2f));
  test::addMesh(scene, test::squareMesh(4.0f, gloss), vec3(2, 0, 0));
  const NodeId box = test::addMesh(scene, test::boxMesh(vec3(0.8f), gloss), vec3(-1.2f, 0.4f, 0));
  const NodeId lamp = test::addRectangleLight(scene, vec3(0.3f, 3, 0), vec2(0.6f), vec3(20));
  const NodeId bulb = test::addNode(scene, "bulb", kNoNode, vec3(1, 2, 1));
  scene.find(bulb)->punctual = PunctualLight{PunctualKind::point, vec3(3, 4, 5)};
  const View view = test::lookAt(vec3(0, 4, 4.5f), vec3(0), 128, 80, 0.8f);
  Settings settings;
  settings.set("indirect", std::string("samples"));
  settings.set("vpls", 64);
  settings.set("bounces", 1);
  settings.set("antialias", 1);
  settings.set("updates", 4096);
  settings.set("technique", std::string(GetParam().technique));
  settings.set("block", std::string(GetParam().block));
  settings.set("speculars", GetParam().speculars);
  FrameRenderer gl(makeGlBackend()), cpu(makeCpuBackend());
  const Image plain = test::settledPicture(gl, scene, SceneChanges::all(), view, settings);
  const Scene before = scene;
  scene.find(lamp)->light.leftOut = {left, strip};
  scene.find(bulb)->light.leftOut = {box};
  // One picture after an edit on the gl backend, the other rendered fresh on the cpu backend.
  const Image a = test::settledPicture(gl, scene, compare(before, scene), view, settings);
  const Image b = test::settledPicture(cpu, scene, SceneChanges::all(), view, settings);
  const Metrics m = compareImages(a, b);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.03);
  EXPECT_NEAR(m.bias, 1.0, 0.003);
  EXPECT_GT(compareImages(plain, b).relRmse, 0.2);
}

INSTANTIATE_TEST_SUITE_P(All, GlLinking,
                         testing::Values(Variant{"naive", "1", false}, Variant{"naive", "1", true},
                                         Variant{"light_maps", "1", true},
                                         Variant{"light_maps", "4", false}));

}  // namespace
}  // namespace lamplighter
