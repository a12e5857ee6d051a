// Camera bookmarks, the cameras of the level, and camera steps by keys.
#include <filesystem>
#include <fstream>

#include "editor/session/user_state.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class CameraActions : public test::SessionFixture {
 protected:
  void addMore(Scene& scene) override {
    scene.cameras.push_back({"lens", 0.5f});
    Node node;
    node.id = scene.nextId++;
    node.name = "from above";
    node.camera = 0;
    node.local.translation = vec3(0, 9, 0);
    scene.nodes.push_back(node);
  }
};

TEST_F(CameraActions, ABookmarkRestoresTheView) {
  const View before = session_.view();
  const uint64_t was = hash();
  ASSERT_TRUE(session_.runAction("bookmark.store 3"));
  EXPECT_NE(hash(), was);
  EXPECT_TRUE(session_.modified());
  lookFrom(vec3(5, 5, 5), -0.7f);
  ASSERT_TRUE(session_.runAction("bookmark.go 3"));
  EXPECT_EQ(session_.view(), before);
  session_.undo();
  EXPECT_EQ(hash(), was);
  EXPECT_FALSE(session_.modified());
  EXPECT_FALSE(session_.runAction("bookmark.go 3"));
  session_.redo();
  EXPECT_TRUE(session_.runAction("bookmark.go 3"));
  ASSERT_TRUE(session_.runAction("bookmark.clear 3"));
  EXPECT_EQ(hash(), was);
}

TEST_F(CameraActions, BookmarksAreSavedWithTheLevel) {
  const fs::path folder = fs::path(testing::TempDir()) / "lamplighter_bookmarks";
  fs::create_directories(folder);
  for (const char* file : {"a.gltf", "b.glb"}) {
    session_.runAction("bookmark.store 1");
    lookFrom(vec3(1, 2, 3), 0.3f);
    session_.runAction("bookmark.store 9");
    session_.save(folder / file);
    const LoadedScene loaded = loadGltf(folder / file);
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(loaded.scene.bookmarks, session_.document().scene.bookmarks);
    // Saving without bookmarks removes them from the file.
    Scene without = loaded.scene;
    without.bookmarks.clear();
    saveGltf(without, folder / file);
    EXPECT_TRUE(loadGltf(folder / file).scene.bookmarks.empty());
  }
  fs::remove_all(folder);
}

TEST_F(CameraActions, MalformedBookmarksAreIgnoredWithAWarning) {
  const fs::path file = fs::path(testing::TempDir()) / "lamplighter_bad_bookmarks.gltf";
  const std::string good = R"({"slot":2,"eye":[1,2,3],"rotation":[0,0,0,1],"yfov":0.9})";
  const auto load = [&](const std::string& bookmarks) {
    std::ofstream(file) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"extras":)"
                        << R"({"lamplighter":{"bookmarks":)" << bookmarks << "}}}]}";
    return loadGltf(file);
  };
  EXPECT_EQ(load("[" + good + "]").scene.bookmarks.size(), 1u);
  for (const std::string& bad :
       {std::string(R"({"slot":0,"eye":[1,2,3],"rotation":[0,0,0,1],"yfov":0.9})"),
        std::string(R"({"slot":10,"eye":[1,2,3],"rotation":[0,0,0,1],"yfov":0.9})"),
        std::string(R"({"slot":1,"eye":[1,2],"rotation":[0,0,0,1],"yfov":0.9})"),
        std::string(R"({"slot":1,"eye":[1,2,1e300],"rotation":[0,0,0,1],"yfov":0.9})"),
        std::string(R"({"slot":1,"eye":[1,2,3],"rotation":[0,0,0,0],"yfov":0.9})"),
        std::string(R"({"slot":1,"eye":[1,2,3],"rotation":"up","yfov":0.9})"),
        std::string(R"({"slot":1,"eye":[1,2,3],"rotation":[0,0,0,1],"yfov":-1})"), good,
        std::string("7"), std::string("null")}) {
    const LoadedScene loaded = load("[" + good + "," + bad + "]");
    EXPECT_EQ(loaded.scene.bookmarks.size(), 1u) << bad;
    EXPECT_GE(loaded.warnings.size(), 1u) << bad;
    EXPECT_NE(loaded.warnings[0].find("bookmark"), std::string::npos) << loaded.warnings[0];
  }
  EXPECT_TRUE(load("{}").scene.bookmarks.empty());
  EXPECT_TRUE(load("\"many\"").scene.bookmarks.empty());
  fs::remove(file);
}

TEST_F(CameraActions, NumbersOutOfRangeAreRefused) {
  const uint64_t was = hash();
  for (const char* bad : {"bookmark.store 0", "bookmark.store 10", "bookmark.store 1.5",
                          "bookmark.store x", "bookmark.clear 2", "camera.go floor"})
    EXPECT_FALSE(session_.runAction(bad)) << bad;
  EXPECT_EQ(hash(), was);
}

TEST_F(CameraActions, DigitKeysStoreAndRecallBookmarks) {
  EXPECT_EQ(session_.actions().textForKey(Key::n7, {.ctrl = true}), "bookmark.store 7");
  EXPECT_EQ(session_.actions().textForKey(Key::n7, {}), "bookmark.go 7");
}

TEST_F(CameraActions, CamerasOfTheLevelAreListedAndUsed) {
  const Action& action = *session_.actions().find("camera.go");
  const std::vector<ActionChoice> choices = action.choices(session_);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].argument, "from above");
  ASSERT_TRUE(session_.runAction("camera.go \"from above\""));
  EXPECT_EQ(session_.view().eye, vec3(0, 9, 0));
  EXPECT_FLOAT_EQ(session_.view().yfov, 0.5f);
}

TEST_F(CameraActions, CameraStepsAreRelativeToTheView) {
  const View before = session_.view();
  ASSERT_TRUE(session_.runAction("camera.move 0 0 2"));
  const vec3 step = session_.view().eye - before.eye;
  EXPECT_NEAR(glm::dot(glm::normalize(step), before.forward()), 1.0f, 1e-5f);
  EXPECT_NEAR(glm::length(step), 0.5f * session_.cameraSpeed(), 1e-4f);
  ASSERT_TRUE(session_.runAction("camera.turn 90 0"));
  EXPECT_NEAR(glm::dot(session_.view().forward(), -before.right()), std::cos(0.25f), 0.02f);
  // The camera never turns upside down.
  for (int i = 0; i < 20; ++i) session_.runAction("camera.turn 0 45");
  EXPECT_GT(session_.view().up().y, 0.0f);
}

}  // namespace
}  // namespace lamplighter
