// Light is linear: a settled picture follows changes of brightness in the next frame, without new
// samples, rays or sums.
#include <random>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A room with every kind of light.
struct Mix {
  Scene scene = test::randomBoxes(14, 4);
  View view = test::lookAt(vec3(0.5f, 2.2f, 7.5f), vec3(0.0f, 1.4f, 0.0f), 150, 100);
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};
  NodeId area = kNoNode, point = kNoNode, glowingBox = kNoNode;
  int glowing = kNone;

  Mix() {
    area = test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(6, 5, 3));
    glowing = test::addMaterial(scene, vec3(0.2f), vec3(1.5f, 0.4f, 0.2f));
    glowingBox = test::addMesh(scene, test::boxMesh(vec3(0.3f), glowing), vec3(-2.0f, 1.0f, 1.0f));
    test::addMesh(scene, test::boxMesh(vec3(0.2f), glowing), vec3(1.0f, 1.2f, 2.0f));
    Node lamp;
    lamp.id = point = 9001;
    lamp.local.translation = vec3(2.0f, 2.5f, 2.0f);
    lamp.punctual = PunctualLight{.intensity = vec3(4, 5, 9)};
    scene.nodes.push_back(lamp);
    lamp.id = 9002;
    lamp.punctual = PunctualLight{.kind = PunctualKind::spot, .intensity = vec3(9, 2, 1)};
    scene.nodes.push_back(lamp);
    scene.sky = Sky(vec3(0.3f, 0.4f, 0.6f));
    settings.set("vpls", 80);
    settings.set("antialias", 2);
    settings.set("settled_map_scale", 2);
    settings.set("map_resolution", 16);
  }
  Node& node(NodeId id) { return *scene.find(id); }
  GiOutput frame(const SceneChanges& changes) {
    return renderer.render({scene, changes, view, "many_lights", settings});
  }
  Image settle(const SceneChanges& changes) {
    return test::settledPicture(renderer, scene, changes, view, settings);
  }
  double differenceOfShares() {
    const Image shares = fresh();
    settings.set("share_memory", 0);
    const Image whole = fresh();
    settings.reset("share_memory");
    return compareImages(shares, whole).relRmse;
  }
  Image fresh() const { return test::freshPicture(makeCpuBackend(), scene, view, settings); }
};

void scaleBrightness(Mix& mix, float factor) {
  mix.node(mix.area).area->radiance *= factor;
  mix.node(mix.point).punctual->intensity *= vec3(factor, 1.0f, 0.9f);
  mix.scene.materials[static_cast<size_t>(mix.glowing)].emissive *= vec3(1.0f, factor, 1.0f);
  mix.scene.sky.radiance *= vec3(1.0f, 1.0f, factor);
}

using Edit = std::function<void(Mix&)>;
struct Named {
  const char* name;
  Edit edit;
};
void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

class LinearEdit : public testing::TestWithParam<Named> {};

TEST_P(LinearEdit, IsExactInTheNextFrame) {
  Mix mix;
  const Image first = mix.settle(SceneChanges::all());
  const Scene before = mix.scene;
  GetParam().edit(mix);
  const ManyLightsCounts counts = test::lightCounts(mix.renderer.backend());
  const uint64_t rays = mix.renderer.backend().counts().rays;
  const GiOutput out = mix.frame(compare(before, mix.scene));
  EXPECT_TRUE(out.settled);
  EXPECT_EQ(out.stats.raysTraced, 0u);
  EXPECT_EQ(mix.renderer.backend().counts().rays, rays);
  EXPECT_EQ(test::lightCounts(mix.renderer.backend()).shadowMaps, counts.shadowMaps);
  EXPECT_EQ(test::lightCounts(mix.renderer.backend()).lightPixels, counts.lightPixels);
  const Image next = out.radiance->pixels();
  EXPECT_FALSE(test::sameBits(next, first));
  EXPECT_TRUE(test::sameBits(next, mix.fresh()));
  // Undone, it has the bits from before.
  const Scene edited = std::exchange(mix.scene, before);
  EXPECT_TRUE(test::sameBits(mix.frame(compare(edited, mix.scene)).radiance->pixels(), first));
}
INSTANTIATE_TEST_SUITE_P(
    Kinds, LinearEdit,
    testing::Values(
        Named{"area light",
              [](Mix& m) { m.node(m.area).area->radiance *= vec3(1.1f, 0.7f, 1.0f); }},
        Named{"point light", [](Mix& m) { m.node(m.point).punctual->intensity *= 1.3f; }},
        Named{"material",
              [](Mix& m) { m.scene.materials[static_cast<size_t>(m.glowing)].emissive *= 0.8f; }},
        Named{"sky", [](Mix& m) { m.scene.sky.radiance *= vec3(0.9f, 1.0f, 1.2f); }},
        Named{"area light off", [](Mix& m) { m.node(m.area).light.on = false; }},
        Named{"point light off", [](Mix& m) { m.node(m.point).light.on = false; }},
        Named{"material off", [](Mix& m) { m.node(m.glowingBox).light.on = false; }},
        Named{"sky off", [](Mix& m) { m.scene.skyLight.on = false; }},
        Named{"solo", [](Mix& m) { m.node(m.point).light.solo = true; }},
        Named{"all together", [](Mix& m) { scaleBrightness(m, 1.05f); }}));

TEST(LightShares, ALightThatStartsOffComesOnInTheNextFrame) {
  Mix mix;
  mix.node(mix.area).light.on = false;
  mix.settle(SceneChanges::all());
  const Scene before = mix.scene;
  mix.node(mix.area).light.on = true;
  const GiOutput out = mix.frame(compare(before, mix.scene));
  EXPECT_TRUE(out.settled);
  EXPECT_TRUE(test::sameBits(out.radiance->pixels(), mix.fresh()));
}

// After a change beyond a step of the reference brightness, samples are distributed again, over
// several frames. Until they are there, the picture is the mix of the samples from before.
TEST(LightShares, ALargeChangeIsShownAtOnceAndSettlesToTheBitsOfAFreshRender) {
  Mix mix;
  Image last = mix.settle(SceneChanges::all());
  const Scene dim = mix.scene;
  for (Node& n : mix.scene.nodes) {
    if (n.area) n.area->radiance *= 100.0f;
    if (n.punctual) n.punctual->intensity *= 100.0f;
  }
  for (Material& m : mix.scene.materials) m.emissive *= 100.0f;
  mix.scene.sky.radiance *= 100.0f;
  const uint64_t rays = mix.renderer.backend().counts().rays;
  GiOutput out = mix.frame(compare(dim, mix.scene));
  EXPECT_FALSE(out.settled);
  EXPECT_EQ(out.stats.raysTraced, 0u);
  EXPECT_EQ(mix.renderer.backend().counts().rays, rays);
  for (vec3& p : last.pixels) p *= 100.0f;
  EXPECT_LT(compareImages(out.radiance->pixels(), last).relRmse, 1e-5);
  const auto shown = out.radiance;
  for (out = mix.frame({}); !out.settled; out = mix.frame({})) EXPECT_EQ(out.radiance, shown);
  EXPECT_TRUE(test::sameBits(out.radiance->pixels(), mix.fresh()));
  for (const float factor : {100.0f, 1e-3f}) {
    const Scene before = mix.scene;
    scaleBrightness(mix, factor);
    const Image kept = mix.settle(compare(before, mix.scene)), fresh = mix.fresh();
    EXPECT_TRUE(test::sameBits(kept, fresh)) << factor;
  }
}

// The sum of the shares is the picture that is summed at once. Interpolation depends on where the
// light of a share varies, not that of the sum.
TEST(LightShares, AddUpToThePicture) {
  Mix mix;
  EXPECT_LT(mix.differenceOfShares(), 0.06);
  mix.settings.set("bias_compensation", false);
  mix.settings.set("block", std::string("1"));
  EXPECT_LT(mix.differenceOfShares(), 0.005);
  mix.settings.set("technique", std::string("visibility"));
  mix.settings.set("antialias", 1);
  EXPECT_LT(mix.differenceOfShares(), 1e-5);
}

TEST(LightShares, ArePartlyLeftOutIfMemoryIsShort) {
  Mix mix;
  mix.settings.set("share_memory", 1);
  mix.settle(SceneChanges::all());
  const GiOutput at = mix.frame({});
  EXPECT_EQ(at.stats.of("lights_without_share"), 5);
  EXPECT_LE(at.stats.of("share_bytes"), 1 << 20);
  Scene before = mix.scene;
  scaleBrightness(mix, 1.1f);
  EXPECT_TRUE(test::sameBits(mix.settle(compare(before, mix.scene)), mix.fresh()));
  // Lights with one share may change together.
  before = mix.scene;
  for (Node& n : mix.scene.nodes) {
    if (n.area) n.area->radiance *= 0.9f;
    if (n.punctual) n.punctual->intensity *= 0.9f;
  }
  for (Material& m : mix.scene.materials) m.emissive *= 0.9f;
  mix.scene.sky.radiance *= 0.9f;
  const Image next = mix.frame(compare(before, mix.scene)).radiance->pixels();
  // Rounding may move the border of what is interpolated.
  EXPECT_LT(compareImages(next, mix.fresh()).relRmse, 1e-3);
  EXPECT_TRUE(test::sameBits(mix.settle({}), mix.fresh()));
}

struct AnyEdit {
  enum class Kind { brighten, switchLight, turnCamera, move, wait } kind;
  uint32_t which;
  float amount;
};

void apply(Mix& mix, const AnyEdit& edit) {
  switch (edit.kind) {
    case AnyEdit::Kind::brighten:
      scaleBrightness(mix, std::exp2(edit.amount));
      break;
    case AnyEdit::Kind::switchLight: {
      LightState& light = mix.node(edit.which % 2 == 0 ? mix.area : mix.point).light;
      (edit.which % 3 == 0 ? light.solo : light.on) ^= true;
      break;
    }
    case AnyEdit::Kind::turnCamera:
      mix.view = test::lookAt(vec3(0.5f + 0.3f * edit.amount, 2.2f, 7.5f), vec3(0.0f, 1.4f, 0.0f),
                              150, 100);
      break;
    case AnyEdit::Kind::move: {
      const size_t count = mix.scene.nodes.size();
      mix.scene.nodes[edit.which % count].local.translation.x += 0.3f * edit.amount;
      break;
    }
    case AnyEdit::Kind::wait:
      break;
  }
}

class RandomMix : public testing::TestWithParam<uint32_t> {};

TEST_P(RandomMix, LeavesTheBitsOfAFreshRender) {
  std::mt19937 random(GetParam());
  Mix mix;
  mix.settle(SceneChanges::all());
  for (int i = 0; i < 24; ++i) {
    const auto kind = static_cast<AnyEdit::Kind>(random() % 5);
    const AnyEdit edit{kind, static_cast<uint32_t>(random()),
                       static_cast<float>(random() >> 8) / 8388608.0f - 1.0f};
    const Scene before = mix.scene;
    apply(mix, edit);
    SceneChanges changes = compare(before, mix.scene);
    for (uint32_t frame = 0; frame <= random() % 6; ++frame, changes = {}) mix.frame(changes);
  }
  EXPECT_TRUE(test::sameBits(mix.settle({}), mix.fresh()));
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomMix, testing::Range(1u, 9u));

}  // namespace
}  // namespace lamplighter
