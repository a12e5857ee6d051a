// Actions that change the sky, with undo and redo.
#include <fstream>

#include <gmock/gmock.h>

#include "editor/document/sky_text.h"
#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

using testing::HasSubstr;

class SkyActions : public test::SessionFixture {
 protected:
  const Sky& sky() const { return session_.document().scene.sky; }
};

TEST_F(SkyActions, SetUndoAndRedo) {
  const uint64_t before = hash();
  EXPECT_TRUE(session_.runAction("sky.set gradient:0.1,0.2,0.9/1,1,1/0.2,0.2,0.1"));
  EXPECT_EQ(sky(), Sky::gradient(vec3(0.1f, 0.2f, 0.9f), vec3(1), vec3(0.2f, 0.2f, 0.1f)));
  const uint64_t after = hash();
  EXPECT_NE(after, before);
  EXPECT_TRUE(session_.modified());
  session_.runAction("edit.undo");
  EXPECT_TRUE(sky().isBlack());
  EXPECT_EQ(hash(), before);
  session_.runAction("edit.redo");
  EXPECT_EQ(hash(), after);
  EXPECT_TRUE(session_.runAction("sky.set 0.5,0.6,0.7"));
  EXPECT_EQ(sky(), Sky(vec3(0.5f, 0.6f, 0.7f)));
  EXPECT_TRUE(session_.runAction("sky.set none"));
  EXPECT_TRUE(sky().isBlack());
}

TEST_F(SkyActions, PicturesAreRotatedAndScaled) {
  const test::TemporaryFolder folder;
  test::throughFile(test::cloudySky().image->pixels, folder.path() / "the sky.exr");
  const std::string file = "\"" + (folder.path() / "the sky.exr").string() + "\"";
  ASSERT_TRUE(session_.runAction("sky.image " + file)) << session_.status();
  EXPECT_EQ(sky().kind, SkyKind::image);
  EXPECT_TRUE(session_.runAction("sky.rotate 90"));
  EXPECT_TRUE(session_.runAction("sky.scale 2"));
  EXPECT_NEAR(sky().rotation, 0.5f * kPi, 1e-6f);
  EXPECT_EQ(sky().scale, 2.0f);
  session_.renderFrame();
  EXPECT_EQ(session_.renderError(), "");
  // A new picture keeps the rotation and the scale.
  ASSERT_TRUE(session_.runAction("sky.image " + file));
  EXPECT_EQ(sky().scale, 2.0f);
  session_.runAction("edit.undo");
  session_.runAction("edit.undo");
  EXPECT_EQ(sky().scale, 1.0f);
}

TEST_F(SkyActions, BadInputChangesNothing) {
  const uint64_t before = hash();
  for (const char* action :
       {"sky.set", "sky.set 1,2", "sky.set 1,2,x", "sky.set -1,0,0", "sky.set 1,1,inf",
        "sky.set gradient:1,1,1/2,2,2", "sky.set gradient:1,1,1/2,2/3,3,3",
        "sky.set nowhere/gone.exr", "sky.image gone.exr", "sky.image"}) {
    EXPECT_FALSE(session_.runAction(action)) << action;
    EXPECT_EQ(session_.status().find('\n'), std::string::npos) << action;
    EXPECT_EQ(hash(), before) << action;
  }
  EXPECT_TRUE(session_.runAction("sky.rotate 10"));  // disabled: there is no picture to rotate
  EXPECT_EQ(hash(), before);
}

// A change turns the default sky of a scene without light into an ordinary sky. Undo restores it.
TEST_F(SkyActions, AnEditEndsTheDefaultSky) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(1.0f));
  scene.sky = kDefaultSky;
  scene.skyIsDefault = true;
  open(std::move(scene));
  session_.runAction("sky.set 0.5");
  EXPECT_FALSE(session_.document().scene.skyIsDefault);
  session_.runAction("edit.undo");
  EXPECT_TRUE(session_.document().scene.skyIsDefault);
  EXPECT_EQ(sky(), Sky(kDefaultSky));
}

TEST(SkyText, FindsPicturesBesideTheScene) {
  const test::TemporaryFolder folder;
  test::throughFile(test::cloudySky().image->pixels, folder.path() / "beside.exr");
  EXPECT_EQ(parseSky("beside.exr", folder.path()),
            test::cloudySky().kind == SkyKind::image
                ? parseSky((folder.path() / "beside.exr").string())
                : Sky());
  EXPECT_THROW(parseSky("beside.exr"), InputError);
}

}  // namespace
}  // namespace lamplighter
