// If a frame cannot be rendered, the document and the last picture stay.
#include <atomic>
#include <functional>
#include <new>
#include <stdexcept>
#include <thread>

#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/registry/registry.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/failing_kernels.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter {
namespace {

class RenderFailure : public testing::Test {
 protected:
  std::shared_ptr<test::KernelHooks> hooks_ = std::make_shared<test::KernelHooks>();
  Session session_{std::make_unique<FrameRenderer>(test::failingBackend(hooks_))};
  NodeId light_ = 0;
  int attempts_ = 0;  // that failed by failWith()

  void SetUp() override {
    hooks_->reserve = [](const MapRoom& coarse) {
      if (coarse.resolution > 32)
        throw InputError("many_lights", "no memory", "lower map_resolution");
    };
    Scene scene;
    test::addMesh(scene, test::squareMesh(10.0f, test::addMaterial(scene, vec3(0.6f))));
    light_ = test::addRectangleLight(scene, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    session_.resizeViewport(32, 24);
    session_.open(std::move(scene), "test.gltf", {});
    RenderSettings render;
    render.values.set("vpls", 8);
    render.values.set("map_resolution", 16);
    session_.editing().setInitialRender(std::move(render));
  }
  std::vector<vec3> settle() {
    for (int i = 0; i < 1000 && !session_.renderFrame().settled; ++i) {
    }
    EXPECT_TRUE(session_.output().settled);
    return session_.output().radiance->pixels().pixels;
  }
  // Every picture fails with this exception.
  template <typename E>
  void failWith(E exception) {
    hooks_->compose = [this, exception] {
      ++attempts_;
      throw exception;
    };
  }
  void stopFailing() {
    hooks_->compose = [] {};
  }
  // Number of messages with this text.
  int messages(const std::string& text) const {
    int count = 0;
    for (const Notice& n : session_.home().notices.all())
      if (n.text.find(text) != std::string::npos) count += n.count;
    return count;
  }
  uint64_t hash() const { return documentHash(session_.document()); }
  // The settled picture of a new session with the same document.
  std::vector<vec3> freshPicture() const {
    Session fresh(std::make_unique<FrameRenderer>(makeCpuBackend()));
    fresh.resizeViewport(32, 24);
    fresh.open(session_.document().scene, "test.gltf", {});
    fresh.editing().setInitialRender(session_.document().render);
    fresh.setView(session_.view());
    while (!fresh.renderFrame().settled) {
    }
    return fresh.output().radiance->pixels().pixels;
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
  EXPECT_EQ(settle(), freshPicture());
}

TEST_F(RenderFailure, OfTheFirstFrameGivesABlackPicture) {
  ASSERT_TRUE(session_.runAction("render.set map_resolution=64"));
  ASSERT_NE(session_.renderFrame().radiance, nullptr);
  EXPECT_EQ(session_.output().radiance->pixels().pixels, std::vector<vec3>(32 * 24, vec3(0.0f)));
}

TEST_F(RenderFailure, AnExceptionIsToldOnceAndTheNextEditRendersAgain) {
  const auto before = settle();
  session_.select({light_});
  const uint64_t document = hash();
  failWith(std::bad_alloc());
  ASSERT_TRUE(session_.runAction("object.move 2 1 0"));
  const uint64_t moved = hash();
  for (int i = 0; i < 60; ++i) EXPECT_EQ(session_.renderFrame().radiance->pixels().pixels, before);
  EXPECT_EQ(attempts_, 2);  // the second one is from scratch
  EXPECT_TRUE(session_.output().settled);
  EXPECT_EQ(messages("out of memory"), 1);
  EXPECT_EQ(session_.status(), session_.renderError());
  EXPECT_EQ(hash(), moved);
  session_.undo();
  EXPECT_EQ(hash(), document);
  for (int i = 0; i < 3; ++i) session_.renderFrame();
  EXPECT_EQ(attempts_, 3);  // a change: it is tried again
  EXPECT_EQ(messages("out of memory"), 1);

  stopFailing();
  ASSERT_TRUE(session_.runAction("object.move 0 0 1"));
  EXPECT_EQ(settle(), freshPicture());
  EXPECT_TRUE(session_.renderError().empty());
}

TEST_F(RenderFailure, APassingExceptionNeedsNoEdit) {
  settle();
  failWith(std::runtime_error("Embree error 2"));
  session_.select({light_});
  ASSERT_TRUE(session_.runAction("object.move 2 1 0"));
  session_.renderFrame();
  EXPECT_NE(session_.renderError().find("Embree error 2"), std::string::npos);
  EXPECT_FALSE(session_.output().settled);
  stopFailing();
  EXPECT_EQ(settle(), freshPicture());
  EXPECT_EQ(messages("Embree error 2"), 1);
}

TEST_F(RenderFailure, TheGlBackendIsReplacedAfterTwoExceptions) {
  session_.renderer().setBackend(std::make_unique<test::FailingGl>(hooks_));
  failWith(DeviceError("OpenGL: the graphics device is out of memory"));
  session_.renderFrame();
  EXPECT_EQ(session_.renderer().backend().info().name, "gl");
  const auto picture = settle();
  EXPECT_EQ(attempts_, 2);
  EXPECT_EQ(session_.renderer().backend().info().name, "cpu");
  EXPECT_EQ(messages("graphics device is out of memory"), 1);
  EXPECT_EQ(messages("the cpu backend renders"), 1);
  EXPECT_EQ(picture, freshPicture());
}

TEST_F(RenderFailure, TheGlBackendStaysAfterAnInputError) {
  session_.renderer().setBackend(std::make_unique<test::FailingGl>(hooks_));
  ASSERT_TRUE(session_.runAction("render.set map_resolution=64"));
  for (int i = 0; i < 5; ++i) session_.renderFrame();
  EXPECT_EQ(session_.renderer().backend().info().name, "gl");
}

TEST_F(RenderFailure, TheJournalHasTheEditsOfFramesThatFail) {
  const test::TemporaryFolder folder;
  session_.keepJournal(folder.path(), 7, [] { return int64_t{1'000'000}; });
  failWith(std::bad_alloc());
  session_.select({light_});
  for (const char* edit :
       {"object.move 2 1 0", "light.add sphere", "edit.undo", "render.set vpls=9"}) {
    ASSERT_TRUE(session_.runAction(edit)) << session_.status();
    session_.renderFrame();
  }
  EXPECT_GT(attempts_, 0);
  session_.crashRecovery() = {};  // as after a crash: only the lock disappears
  const auto found = findRecoverable(folder.path());
  ASSERT_EQ(found.size(), 1u);
  const Recovered recovered = recover(found.front().folder);
  EXPECT_EQ(recovered.warning, "");
  EXPECT_EQ(documentHash(recovered.document), hash());
}

// many_lights whose transfer cannot be computed while this is not null.
std::function<void()> failTransfer;
const char* methodOfFailingTransfer() {
  static const std::string name = [] {
    MethodInfo method = manyLightsInfo();
    method.name = "failing_transfer";
    method.make = [](Backend& backend) {
      return std::make_unique<ManyLights>(
          backend.kernels<ManyLightsKernels>("many_lights"),
          [](const RenderScene& own, const TransferOptions& options, TransferProgress* progress) {
            if (failTransfer) failTransfer();
            return computeTransfer(own, options, progress);
          });
    };
    addMethod(method);
    return method.name;
  }();
  return name.c_str();
}

// A picture lacks the transfer that its thread could not compute.
TEST_F(RenderFailure, OfTheThreadOfTransferIsTold) {
  Scene scene = session_.document().scene;
  const NodeId sphere = test::addMesh(scene, test::sphereMesh(0.5f, 16), vec3(0.0f, 1.0f, 0.0f));
  session_.open(std::move(scene), "test.gltf", {});
  RenderSettings render;
  render.method = methodOfFailingTransfer();
  render.values.set("vpls", 8);
  render.values.set("map_resolution", 16);
  render.values.set("prt", true);
  std::atomic<int> failed = 0;
  failTransfer = [&] {
    ++failed;
    throw std::runtime_error("Embree error 2");
  };
  session_.editing().setInitialRender(render);
  const uint64_t document = hash();
  // As in the window: frames with a budget do not wait.
  const auto settleInBackground = [&] {
    for (int i = 0; i < 100000 && !session_.renderFrame(16, {.inBackground = true}).settled; ++i)
      std::this_thread::yield();
    EXPECT_TRUE(session_.output().settled);
    return session_.output().radiance->pixels().pixels;
  };
  const auto lacking = settleInBackground();
  EXPECT_EQ(failed, 1);
  EXPECT_EQ(messages("Embree error 2"), 1);
  EXPECT_EQ(session_.renderError(), "");  // the picture itself did not fail
  EXPECT_EQ(hash(), document);
  for (int i = 0; i < 3; ++i) session_.renderFrame(16, {.inBackground = true});
  EXPECT_EQ(messages("Embree error 2"), 1);

  // The next change of the object tries again.
  failTransfer = nullptr;
  session_.select({sphere});
  ASSERT_TRUE(session_.runAction("object.move 0 1 0"));
  ASSERT_TRUE(session_.runAction("object.move 0 -1 0"));
  EXPECT_TRUE(settleInBackground() != lacking);
  EXPECT_EQ(messages("Embree error 2"), 1);
}

// An action that edits and then throws is undone, whatever it throws.
TEST_F(RenderFailure, AnActionThatThrowsLeavesTheDocument) {
  const auto fail = [&](const std::string& name, const std::function<void()>& raise) {
    Action action;
    action.name = name;
    action.run = [this, raise](Session& session, const std::vector<std::string>&) {
      Transaction edit = session.editing().begin("Fail");
      edit.node(light_).name = "changed";
      edit.sky().scale = 2.0f;
      raise();
      edit.commit();
    };
    session_.actions().add(std::move(action));
    const uint64_t before = hash();
    const size_t step = session_.history().position();
    EXPECT_FALSE(session_.runAction(name));
    EXPECT_EQ(hash(), before);
    EXPECT_EQ(session_.history().position(), step);
    EXPECT_FALSE(session_.editing().inTransaction());
  };
  fail("test.memory", [] { throw std::bad_alloc(); });
  EXPECT_NE(session_.status().find("out of memory"), std::string::npos);
  fail("test.runtime", [] { throw std::runtime_error("of a library"); });
  EXPECT_NE(session_.status().find("of a library"), std::string::npos);
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
