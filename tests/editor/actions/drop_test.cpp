// Files dropped on the window (levels, skies, light profiles), and recent files.
#include <filesystem>
#include <fstream>

#include "editor/session/user_state.h"
#include "renderer/image/image_io.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/folders.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

const std::string kProfile = (test::sourceFolder() / "assets/profiles/downlight.ies").string();

class Drop : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    folder_ = fs::path(testing::TempDir()) / "lamplighter_drop";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  bool drop(const std::string& file) { return session_.runAction("file.drop \"" + file + "\""); }
  fs::path folder_;
};

TEST_F(Drop, ALevelIsOpened) {
  ASSERT_TRUE(drop("/levels/my level.GLB"));
  EXPECT_EQ(session_.takeOpenRequest(), fs::path("/levels/my level.GLB"));
}

TEST_F(Drop, APictureBecomesTheSkyAsOneStep) {
  const uint64_t was = hash();
  writeExr(Image(8, 4, vec3(0.3f)), folder_ / "sky.exr");
  ASSERT_TRUE(drop((folder_ / "sky.exr").string()));
  EXPECT_EQ(session_.document().scene.sky.kind, SkyKind::image);
  session_.undo();
  EXPECT_EQ(hash(), was);
}

TEST_F(Drop, AProfileIsSetOnTheSelectedLights) {
  session_.runAction("light.add point");
  const NodeId a = session_.document().active();
  session_.runAction("light.add spot");
  const NodeId b = session_.document().active();
  session_.select({a, b, box_});
  const uint64_t was = hash();
  ASSERT_TRUE(drop(kProfile)) << session_.status();
  EXPECT_NE(node(a).punctual->profile, nullptr);
  EXPECT_NE(node(b).punctual->profile, nullptr);
  session_.undo();
  EXPECT_EQ(hash(), was);
}

TEST_F(Drop, AProfileWithoutASelectedLightAddsALightUnderThePointer) {
  session_.select({box_});
  const size_t before = session_.document().scene.nodes.size();
  input_.pointer = pixelOf(vec3(2, 0, 0));
  frame();
  ASSERT_TRUE(drop(kProfile)) << session_.status();
  ASSERT_EQ(session_.document().scene.nodes.size(), before + 1);
  const NodeId made = session_.document().active();
  ASSERT_NE(node(made).punctual, std::nullopt);
  EXPECT_NE(node(made).punctual->profile, nullptr);
  EXPECT_NEAR(placeOf(made).x, 2.0f, 0.05f);
  session_.undo();
  EXPECT_EQ(session_.document().scene.nodes.size(), before);
}

TEST_F(Drop, OtherFilesAreRefusedInOneLine) {
  const uint64_t was = hash();
  for (const char* file : {"notes.txt", "/nowhere/at all.ies", "/nowhere/sky.hdr", ""}) {
    EXPECT_FALSE(drop(file)) << file;
    EXPECT_EQ(session_.status().find('\n'), std::string::npos);
    EXPECT_EQ(session_.home().notices.all().back().kind, NoticeKind::error);
  }
  EXPECT_EQ(hash(), was);
}

TEST_F(Drop, RecentFilesAreOpenedByTheirNumber) {
  session_.home().preferences.recentFiles = {"/a.gltf", "/b.gltf"};
  ASSERT_TRUE(session_.runAction("file.open_recent 2"));
  EXPECT_EQ(session_.takeOpenRequest(), fs::path("/b.gltf"));
  for (const char* bad : {"0", "3", "1.5", "x"})
    EXPECT_FALSE(session_.runAction(std::string("file.open_recent ") + bad)) << bad;
  EXPECT_EQ(session_.actions().find("file.open_recent")->choices(session_).size(), 2u);
}

}  // namespace
}  // namespace lamplighter
