// `render --view`: pictures of the engine's insides, and what is said where there is none.
#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "renderer/views/debug_view.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;
using test::runLamplighter;

class RenderView : public testing::Test {
 protected:
  void SetUp() override {
    // Tests run beside each other.
    folder_ = fs::path(testing::TempDir()) /
              (std::string("lamplighter_views_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ProcessResult render(const std::string& output, std::vector<std::string> more) const {
    std::vector<std::string> arguments{
        "render",    std::string(LAMPLIGHTER_SOURCE_DIR) + "/assets/scenes/pillar_room.gltf",
        "-o",        (folder_ / output).string(),
        "--size",    "64x40",
        "--vpls",    "20",
        "--bounces", "1",
        "--backend", "cpu"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runLamplighter(arguments);
  }
  void fails(const std::string& output, std::vector<std::string> more, const std::string& why) {
    const ProcessResult r = render(output, std::move(more));
    EXPECT_EQ(r.code, 2);
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(folder_ / output));
  }

  fs::path folder_;
};

TEST_F(RenderView, WritesEachAndTheyDiffer) {
  std::vector<std::vector<vec3>> pictures;
  for (const DebugViewInfo& info : debugViews()) {
    SCOPED_TRACE(info.name);
    const ProcessResult r =
        render("view.png", {"--view", info.name, "--set", "technique=light_maps"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image image = readImage(folder_ / "view.png");
    for (const auto& other : pictures) EXPECT_NE(other, image.pixels);
    pictures.push_back(image.pixels);
  }
  EXPECT_EQ(render("light.exr", {"--view", "light_only"}).code, 0);
}

TEST_F(RenderView, RefusesWhatItCannotShow) {
  fails("a.png", {"--view", "colour"}, "'colour' is none; give one of lit, light_only");
  fails("a.exr", {"--view", "albedo"}, "is no radiance");
  fails("a.png", {"--view", "occlusion", "--set", "technique=naive"},
        "needs the technique visibility or light_maps");
  fails("a.png", {"--view", "light_maps", "--set", "technique=visibility"}, "needs the technique");
  fails("a.png", {"--view", "map_age", "--method", "reference"}, "needs the light samples");
  fails("a.png", {"--view", "occlusion", "--set", "technique=visibility", "--view-vpl", "1000"},
        "there is no light sample 1000; give one from 0 to ");
}

}  // namespace
}  // namespace lamplighter
