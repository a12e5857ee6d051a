// `render --view`: pictures of internal data, and the errors of views that cannot be shown.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/debug_views/debug_view.h"
#include "renderer/image/image_io.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;
using test::runLamplighter;

class RenderView : public testing::Test {
 protected:
  void SetUp() override {
    // Tests run in parallel.
    folder_ = fs::path(testing::TempDir()) /
              (std::string("lamplighter_views_") +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ProcessResult render(const std::string& output, std::vector<std::string> more) const {
    std::vector<std::string> arguments{
        "render",    (test::sourceFolder() / "assets/scenes/pillar_room.gltf").string(),
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

TEST_F(RenderView, WritesEveryViewAndAllDiffer) {
  std::vector<std::vector<vec3>> pictures;
  for (const DebugViewInfo& info : debugViews()) {
    SCOPED_TRACE(info.name);
    std::vector<std::string> flags{"--view", info.name};
    const auto needs = [&](Capability c) { return std::ranges::count(info.needs, c) > 0; };
    if (!info.method.empty()) {
      flags.insert(flags.end(), {"--method", info.method});
    } else {
      flags.insert(flags.end(),
                   {"--set", "technique=light_maps", "--set", "share_memory=0", "--set",
                    needs(Capability::elements) ? "indirect=meshes" : "indirect=samples"});
      // Only there, because transfer takes seconds.
      if (needs(Capability::transfer)) flags.insert(flags.end(), {"--set", "prt=true"});
    }
    const ProcessResult r = render("view.png", flags);
    ASSERT_EQ(r.code, 0) << r.err;
    const Image image = readImage(folder_ / "view.png");
    for (const auto& other : pictures) EXPECT_NE(other, image.pixels);
    pictures.push_back(image.pixels);
  }
  for (const char* view : {"light_only", "direct", "indirect"})
    EXPECT_EQ(render("light.exr", {"--view", view}).code, 0) << view;
}

TEST_F(RenderView, ALegendIsBelowThePicture) {
  for (const std::string view : {"occlusion", "partial_lights", "light_maps"}) {
    SCOPED_TRACE(view);
    ASSERT_EQ(render("bare.png", {"--view", view}).code, 0);
    const ProcessResult r = render("legend.png", {"--view", view, "--legend"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image bare = readImage(folder_ / "bare.png"), with = readImage(folder_ / "legend.png");
    ASSERT_EQ(with.width, bare.width);
    ASSERT_GT(with.height,
              bare.height + 40);  // the picture is so narrow that each part has its own row
    EXPECT_TRUE(std::equal(bare.pixels.begin(), bare.pixels.end(), with.pixels.begin()));
    // There is bright text on the dark strip.
    float dark = 1.0f, bright = 0.0f;
    for (size_t i = bare.pixels.size(); i < with.pixels.size(); ++i) {
      dark = std::min(dark, with.pixels[i].g);
      bright = std::max(bright, with.pixels[i].g);
    }
    EXPECT_LT(dark, 0.02f);
    EXPECT_GT(bright, 0.4f);
  }
  ASSERT_EQ(render("albedo.png", {"--view", "albedo", "--legend"}).code, 0);
  EXPECT_EQ(readImage(folder_ / "albedo.png").height, 40);  // this view has no legend
}

TEST_F(RenderView, MarksCanBeDrawnOverAnyView) {
  for (const std::string view : {"lit", "flat"}) {
    SCOPED_TRACE(view);
    ASSERT_EQ(render("bare.png", {"--view", view}).code, 0);
    const ProcessResult r = render("marks.png", {"--view", view, "--marks"});
    ASSERT_EQ(r.code, 0) << r.err;
    const Image bare = readImage(folder_ / "bare.png"), with = readImage(folder_ / "marks.png");
    ASSERT_EQ(with.pixels.size(), bare.pixels.size());
    size_t changed = 0;
    for (size_t i = 0; i < bare.pixels.size(); ++i) changed += bare.pixels[i] != with.pixels[i];
    EXPECT_GT(changed, bare.pixels.size() / 20);
    EXPECT_LT(changed, bare.pixels.size() / 2);
  }
}

TEST_F(RenderView, RefusesViewsThatItCannotShow) {
  fails("a.png", {"--view", "colour"}, "there is no view 'colour'; give one of lit, light_only");
  fails("a.exr", {"--view", "albedo"}, "is not radiance");
  fails("a.png", {"--view", "occlusion", "--set", "technique=naive"},
        "needs patches: choose many_lights with the technique visibility or light_maps");
  fails("a.png", {"--view", "light_maps", "--set", "technique=visibility"},
        "needs texels: choose many_lights with the technique light_maps");
  fails("a.png", {"--view", "map_age", "--method", "reference"},
        "needs light samples: choose many_lights");
  fails("a.png", {"--view", "occlusion", "--set", "technique=visibility", "--view-vpl", "1000"},
        "there is no light sample 1000; give one from 0 to ");
  fails("a.png", {"--view", "mesh_age", "--set", "indirect=samples"},
        "needs surface elements: choose many_lights with indirect=meshes, or multi_mesh");
  fails("a.png", {"--view", "prt_objects"}, "choose many_lights with prt");
  fails("a.png", {"--view", "edge_mask", "--set", "block=1"}, "needs block above 1");
  fails("a.exr", {"--view", "false_colour"}, "is not radiance");
  fails("a.exr", {"--marks"}, "marks are not radiance");
  fails("a.exr", {"--legend"}, "a legend is not radiance");
  fails("a.png", {"--marks", "--method", "reference"}, "there are no light samples");
}

}  // namespace
}  // namespace lamplighter
