// Tiles of the split view: all methods at once, their figures, and the exported sheet.
#include <cmath>
#include <filesystem>

#include "editor/session/frame_pacer.h"
#include "editor/split/split_view.h"
#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

class SplitTiles : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    session_.resizeViewport(200, 260);
  }
  void settle() {
    for (int i = 0; i < 2000 && !session_.renderFrame().settled; ++i) {
    }
    EXPECT_TRUE(session_.output().settled);
  }
  void run(const std::string& action) {
    ASSERT_TRUE(session_.runAction(action)) << session_.status();
  }
  SplitView& split() { return session_.split(); }
};

TEST_F(SplitTiles, AreAllMethodsThatShowLight) {
  run("split.tiles");
  std::vector<std::string> titles;
  for (size_t i = 0; i < split().sides(); ++i) titles.push_back(split().title(i));
  session_.renderFrame();
  EXPECT_EQ(split().title(0), "live: many_lights");
  EXPECT_EQ(std::vector(titles.begin() + 1, titles.end()),
            (std::vector<std::string>{"multi_mesh", "surface_shadow_maps", "imperfect_shadow_maps",
                                      "light_field", "reference"}));
  EXPECT_EQ(session_.view().width, session_.tiles().size.x);
  run("split.off");
  session_.renderFrame();
  EXPECT_EQ(session_.view().width, 200);
  EXPECT_EQ(session_.view().height, 260);
}

// Each tile has the picture of a session with this method, also after edits and motions.
TEST_F(SplitTiles, EachFollowsEveryEdit) {
  const std::vector<std::string> sides = {"live", "many_lights,vpls=40", "multi_mesh"};
  run("split.tiles live many_lights,vpls=40 multi_mesh");
  settle();
  Transform moved = local(box_);
  moved.translation.x += 1.0f;
  session_.setNodeTransform(box_, moved);
  session_.renderFrame();
  lookFrom(vec3(0.5f, 2, 6), -0.25f);
  settle();
  for (size_t i = 0; i < 3; ++i) {
    Session alone(std::make_unique<FrameRenderer>(makeCpuBackend()));
    alone.open(session_.document().scene, "test.gltf", {});
    alone.setView(session_.view());
    alone.editing().setInitialRender(
        readSide(sides[i], "many_lights").of(session_.document().render));
    for (int k = 0; k < 2000 && !alone.renderFrame().settled; ++k) {
    }
    EXPECT_TRUE(test::sameBits(split().picture(i)->pixels(), alone.output().radiance->pixels()))
        << sides[i];
  }
}

// However many tiles there are, a frame renders one besides the live picture.
TEST_F(SplitTiles, AFrameRendersOneOfThem) {
  run("split.tiles live many_lights,vpls=20 many_lights,vpls=30");
  session_.renderFrame();
  EXPECT_TRUE(split().picture(1));
  EXPECT_FALSE(split().picture(2));
  const auto first = split().picture(1);
  session_.renderFrame();
  EXPECT_TRUE(split().picture(2));
  EXPECT_EQ(split().picture(1), first);
}

TEST_F(SplitTiles, FiguresAreTheWorkAndTheErrorAgainstTheReference) {
  double now = 0.0;
  session_.setClock([&] { return now += 0.25; });
  run("split.tiles live many_lights,bounces=0 reference,samples_per_pixel=8");
  settle();
  EXPECT_EQ(split().figures(1)[0].find(" s, "), std::string::npos) << "counts limit the work";
  run("split.tiles live many_lights,bounces=0 reference,samples_per_pixel=8");
  FramePacer pacer;
  for (int i = 0; i < 2000 && (i == 0 || !session_.output().settled); ++i)
    pacer.renderFrame(session_);
  const std::vector<std::string> live = split().figures(0), other = split().figures(1),
                                 reference = split().figures(2);
  ASSERT_EQ(other.size(), 2u);
  EXPECT_TRUE(other[0].starts_with("settled after ")) << other[0];
  EXPECT_NE(other[0].find(" s, "), std::string::npos) << other[0];
  const double error = relRmse(averageBlocks(split().picture(1)->pixels(), 4),
                               averageBlocks(split().picture(2)->pixels(), 4));
  EXPECT_GT(error, 0.0);
  EXPECT_EQ(std::stod(other[1]), std::round(1000.0 * error) / 10.0);
  EXPECT_TRUE(other[1].ends_with("% from reference,samples_per_pixel=8")) << other[1];
  EXPECT_EQ(live.size(), 2u);
  EXPECT_EQ(reference.size(), 1u);
  // They start again with an edit.
  session_.select({light_});
  run("lights.brighter");
  session_.renderFrame();
  EXPECT_FALSE(split().figures(2)[0].starts_with("settled")) << split().figures(2)[0];
}

TEST_F(SplitTiles, AreExportedAsOnePicture) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "sheet.png").string();
  run("split.tiles live many_lights,bounces=0");
  settle();
  run("split.export " + file);
  const Image8 sheet = session_.sheet();
  const Image read = readImage(file);
  EXPECT_EQ(read.width, sheet.width);
  EXPECT_EQ(read.height, sheet.height);
  EXPECT_EQ(session_.picture().pixels, sheet.pixels);
  EXPECT_FALSE(session_.runAction("split.export " + file + ".jpg"));
  run("split.show both");
  session_.renderFrame();
  run("split.export " + file);  // both sides, whole
  EXPECT_GE(session_.sheet().width, 2 * 200);
  run("split.off");
  session_.runAction("split.export " + (folder.path() / "none.png").string());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "none.png"));
}

// A click selects what is under the pointer in any tile.
TEST_F(SplitTiles, AreWorkedInLikeTheView) {
  run("split.tiles live many_lights,vpls=20");
  session_.renderFrame();
  for (int tile = 0; tile < 2; ++tile) {
    session_.select({});
    press(session_.tiles().origin(tile) + pixelOf(placeOf(box_)));
    release();
    EXPECT_EQ(session_.document().active(), box_) << tile;
  }
}

// A method that fails says so in its tile; the others go on.
TEST_F(SplitTiles, AFailureStaysInItsTile) {
  int made = 0;
  split().setRenderer([&]() -> std::unique_ptr<FrameRenderer> {
    if (++made == 1) throw InputError("no memory for it");
    return std::make_unique<FrameRenderer>(makeCpuBackend());
  });
  run("split.tiles live many_lights,vpls=20 many_lights,vpls=30");
  settle();
  EXPECT_TRUE(split().on());
  EXPECT_EQ(split().figures(1), std::vector<std::string>{"no memory for it"});
  EXPECT_TRUE(split().picture(2));
  EXPECT_EQ(session_.renderError(), "");
  session_.select({light_});
  run("lights.brighter");  // it is tried again after an edit
  settle();
  EXPECT_TRUE(split().picture(1));
}

TEST_F(SplitTiles, InvalidSidesAreRefused) {
  EXPECT_FALSE(session_.runAction("split.tiles live"));
  EXPECT_FALSE(session_.runAction("split.tiles live nothing"));
  EXPECT_FALSE(split().on());
}

}  // namespace
}  // namespace lamplighter
