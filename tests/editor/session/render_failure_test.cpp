// If a frame cannot be rendered, the document and the last picture stay.
#include "renderer/backends/cpu/many_lights/cpu_many_lights.h"
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

// Kernels of the cpu backend that have no memory for shadow maps of more than 32² texels.
class SmallKernels final : public ManyLightsKernels {
 public:
  explicit SmallKernels(std::unique_ptr<ManyLightsKernels> inner) : inner_(std::move(inner)) {}

  void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                 const RayCaster& rays) override {
    inner_->takeScene(scene, changes, rays);
  }
  void takeGBuffer() override { inner_->takeGBuffer(); }
  BackendCounts counts() const override { return inner_->counts(); }
  const ManyLightsTraits& traits() const override { return inner_->traits(); }
  ManyLightsCounts lightCounts() const override { return inner_->lightCounts(); }
  void reserveShadowMaps(int slots, const MapRoom& coarse, const MapRoom& fine) override {
    if (coarse.resolution > 32)
      throw InputError("many_lights", "no memory", "lower map_resolution");
    inner_->reserveShadowMaps(slots, coarse, fine);
  }
  void dropShadowMaps(std::span<const int> slots) override { inner_->dropShadowMaps(slots); }
  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    inner_->renderShadowMaps(vpls, size);
  }
  void sumVpls(std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
               const PatchLights* patches) override {
    inner_->sumVpls(vpls, params, patches);
  }
  std::shared_ptr<RadianceImage> compose(bool white) override { return inner_->compose(white); }
  std::vector<float> readShadowMap(int slot) override { return inner_->readShadowMap(slot); }

 private:
  std::unique_ptr<ManyLightsKernels> inner_;
};

std::unique_ptr<Backend> smallBackend() {
  auto backend = std::make_unique<cpu::CpuBackend>();
  backend->offer<ManyLightsKernels>([b = backend.get()] {
    return std::make_unique<SmallKernels>(cpu::makeManyLightsKernels(*b));
  });
  return backend;
}

class RenderFailure : public testing::Test {
 protected:
  Session session_{std::make_unique<FrameRenderer>(smallBackend())};
  NodeId light_ = 0;

  void SetUp() override {
    Scene scene;
    test::addMesh(scene, test::squareMesh(10.0f, test::addMaterial(scene, vec3(0.6f))));
    light_ = test::addRectangleLight(scene, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    session_.resizeViewport(32, 24);
    session_.open(std::move(scene), "test.gltf", {});
    RenderSettings render;
    render.values.set("vpls", 8);
    session_.editing().setInitialRender(std::move(render));
  }
  std::vector<vec3> settle() {
    for (int i = 0; i < 1000 && !session_.renderFrame().settled; ++i) {
    }
    EXPECT_TRUE(session_.output().settled);
    return session_.output().radiance->pixels().pixels;
  }
};

TEST_F(RenderFailure, KeepsTheLastPictureAndSaysWhy) {
  ASSERT_TRUE(session_.runAction("render.set map_resolution=16"));
  const auto before = settle();
  EXPECT_TRUE(session_.renderError().empty());
  ASSERT_TRUE(session_.runAction("render.set map_resolution=64"));
  EXPECT_EQ(settle(), before);
  EXPECT_NE(session_.renderError().find("no memory"), std::string::npos);
  EXPECT_EQ(session_.status(), session_.renderError());
  session_.undo();
  EXPECT_EQ(settle(), before);
  EXPECT_TRUE(session_.renderError().empty());
}

TEST_F(RenderFailure, ChangesDuringTheFailureAreShownLater) {
  ASSERT_TRUE(session_.runAction("render.set map_resolution=16"));
  settle();
  ASSERT_TRUE(session_.runAction("render.set map_resolution=64"));
  session_.select({light_});
  ASSERT_TRUE(session_.runAction("object.move 2 1 0"));
  settle();  // these frames fail, but receive the change
  ASSERT_TRUE(session_.runAction("render.set map_resolution=16"));
  const auto after = settle();

  Session fresh(std::make_unique<FrameRenderer>(makeCpuBackend()));
  fresh.resizeViewport(32, 24);
  fresh.open(session_.document().scene, "test.gltf", {});
  fresh.editing().setInitialRender(session_.document().render);
  fresh.setView(session_.view());
  while (!fresh.renderFrame().settled) {
  }
  EXPECT_EQ(after, fresh.output().radiance->pixels().pixels);
}

TEST_F(RenderFailure, OfTheFirstFrameGivesABlackPicture) {
  ASSERT_TRUE(session_.runAction("render.set map_resolution=64"));
  ASSERT_NE(session_.renderFrame().radiance, nullptr);
  EXPECT_EQ(session_.output().radiance->pixels().pixels, std::vector<vec3>(32 * 24, vec3(0.0f)));
}

TEST_F(RenderFailure, RenderSettingsDoNotModifyTheLevel) {
  EXPECT_FALSE(session_.modified());
  ASSERT_TRUE(session_.runAction("render.exposure 2"));
  EXPECT_TRUE(session_.editing().canUndo());
  EXPECT_FALSE(session_.modified());
  session_.select({light_});
  ASSERT_TRUE(session_.runAction("object.move 1 1 1"));
  EXPECT_TRUE(session_.modified());
  session_.undo();
  EXPECT_FALSE(session_.modified());
}

}  // namespace
}  // namespace lamplighter
