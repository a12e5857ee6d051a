// The worker thread of the error meter. It traces the reference of the current document.
#include "ui/app/meter_worker.h"

#include <gtest/gtest.h>

#include "editor/session/session.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class MeterWorkerTest : public testing::Test {
 protected:
  void SetUp() override {
    Scene scene;
    test::addMesh(scene, test::squareMesh(6.0f));
    light_ = test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(5.0f));
    session_.resizeViewport(48, 32);
    session_.open(std::move(scene), "test.gltf", {});
    RenderSettings render = session_.document().render;
    render.values.set("vpls", 8);
    render.values.set("map_resolution", 16);
    session_.editing().setInitialRender(std::move(render));
    session_.watch().meter.setOn(true);
    session_.renderFrame();
  }
  ErrorMeter& meter() { return session_.watch().meter; }
  // Waits without a time limit.
  void waitFor(int samples) {
    while (!meter().reference() || meter().reference()->samples < samples) {
      worker_.exchange(meter());
      std::this_thread::yield();
    }
  }

  Session session_{std::make_unique<FrameRenderer>(makeCpuBackend())};
  NodeId light_ = 0;
  MeterWorker worker_;
};

TEST_F(MeterWorkerTest, TracesTheSamePictureAsASampler) {
  waitFor(3);
  const ReferenceHalves traced = *meter().reference();
  ReferenceSampler sampler;
  sampler.begin(*meter().wanted());
  for (int i = 0; i < traced.samples; ++i) sampler.step();
  EXPECT_TRUE(test::sameBits(traced.first, sampler.halves().first));
  EXPECT_TRUE(test::sameBits(traced.second, sampler.halves().second));
  session_.renderFrame();
  EXPECT_TRUE(meter().estimate());
}

TEST_F(MeterWorkerTest, RestartsAtEachEdit) {
  waitFor(1);
  for (int i = 0; i < 20; ++i) {
    AreaLight light = *session_.document().scene.find(light_)->area;
    light.radiance *= 1.1f;
    session_.setAreaLight(light_, light);
    session_.renderFrame();
    worker_.exchange(meter());
    EXPECT_FALSE(meter().reference() && meter().reference()->subject != meter().wanted()->number);
  }
  waitFor(2);
  const ReferenceHalves traced = *meter().reference();
  ReferenceSampler fresh;
  fresh.begin(*meter().wanted());
  for (int i = 0; i < traced.samples; ++i) fresh.step();
  EXPECT_TRUE(test::sameBits(traced.first, fresh.halves().first));
}

TEST_F(MeterWorkerTest, CanBeDestroyedWhileItTraces) {
  worker_.exchange(meter());  // the destructor runs immediately after
}

}  // namespace
}  // namespace lamplighter
