// Pictures on area lights: emitted flux, orientation, and saving. methods/light_kinds_test.cpp
// compares the rendered pictures with the path tracer.
#include "renderer/scene/light_picture.h"

#include <fstream>

#include <gmock/gmock.h>

#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// Red top left, green top right, blue bottom left, black bottom right.
std::shared_ptr<const LightPicture> quarters() {
  Image8 image(8, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      uint8_t* p = image.at(x, y);
      p[0] = y < 4 && x < 4 ? 255 : 0;
      p[1] = y < 4 && x >= 4 ? 255 : 0;
      p[2] = y >= 4 && x < 4 ? 255 : 0;
    }
  }
  std::string why;
  auto bytes = std::make_shared<const std::vector<uint8_t>>(encodePng(image));
  return decodeLightPicture(bytes, "quarters.png", why);
}

// A floor and an area light with the picture, facing down.
struct Lit {
  Scene scene;
  NodeId lamp;
  explicit Lit(AreaShape shape = AreaShape::rectangle) {
    const int white = test::addMaterial(scene, vec3(0.7f));
    test::addMesh(scene, test::squareMesh(8.0f, white));
    lamp = test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.5f, 1.0f), vec3(12));
    scene.find(lamp)->area->shape = shape;
    scene.find(lamp)->area->picture = quarters();
  }
};

TEST(LightPictures, TheMeanUsesLinearTexels) {
  const auto picture = quarters();
  ASSERT_NE(picture, nullptr);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture->mean[c], 0.25f, 1e-5f);
    EXPECT_NEAR(picture->meanOfDisk[c], 0.25f, 1e-5f);
  }
  AreaLight light;
  light.picture = picture;
  EXPECT_EQ(meanFactor(light), picture->mean);
  light.shape = AreaShape::sphere;  // a sphere does not show the picture
  EXPECT_EQ(meanFactor(light), vec3(1.0f));
}

TEST(LightPictures, FluxIsScaledByTheMean) {
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk}) {
    Lit lit(shape);
    RenderScene render = test::renderSceneOf(lit.scene);
    const vec3 with = LightSet(render).emitters()[0].flux;
    lit.scene.find(lit.lamp)->area->picture = nullptr;
    update(render, lit.scene, SceneChanges::all());
    const vec3 without = LightSet(render).emitters()[0].flux;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(with[c] / without[c], 0.25f, 0.005f) << c;
  }
}

// Seen from the front, as a screen is seen.
TEST(LightPictures, AreUprightFromTheFront) {
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk}) {
    Lit lit(shape);
    Node& lamp = *lit.scene.find(lit.lamp);
    lamp.local = Transform();  // it emits along −Z
    lamp.area->size = vec2(1.0f);
    lit.scene.nodes.erase(lit.scene.nodes.begin());
    const Image seen =
        test::renderReference(lit.scene, test::lookAt(vec3(0, 0, -2), vec3(0), 32, 32, 0.6f), 4, 0);
    const vec3 aboveLeft = seen.at(12, 12), aboveRight = seen.at(19, 12),
               belowLeft = seen.at(12, 19);
    EXPECT_GT(aboveLeft.r, 10.0f);
    EXPECT_LT(aboveLeft.g, 0.5f);
    EXPECT_GT(aboveRight.g, 10.0f);
    EXPECT_LT(aboveRight.r, 0.5f);
    EXPECT_GT(belowLeft.b, 10.0f);
    EXPECT_LT(belowLeft.r, 0.5f);
    EXPECT_EQ(seen.at(19, 19), vec3(0.0f));
  }
}

// After each edit, the incrementally updated RenderScene equals a new one.
TEST(LightPictures, IncrementalUpdatesEqualANewScene) {
  Lit lit;
  RenderScene live = test::renderSceneOf(lit.scene);
  Scene shown = lit.scene;
  const auto edit = [&](const char* what, auto change) {
    change(*lit.scene.find(lit.lamp));
    update(live, lit.scene, compare(shown, lit.scene));
    shown = lit.scene;
    const RenderScene fresh = test::renderSceneOf(lit.scene);
    ASSERT_EQ(live.materials.size(), fresh.materials.size()) << what;
    for (size_t i = 0; i < fresh.materials.size(); ++i)
      EXPECT_TRUE(live.materials[i] == fresh.materials[i]) << what << " " << i;
    EXPECT_TRUE(live.textures == fresh.textures) << what;
  };
  edit("brighter", [](Node& n) { n.area->radiance *= 2.0f; });
  edit("off", [](Node& n) { n.light.on = false; });
  edit("on", [](Node& n) { n.light.on = true; });
  edit("larger", [](Node& n) { n.area->size *= 1.5f; });
  edit("a sphere", [](Node& n) { n.area->shape = AreaShape::sphere; });
  edit("a disk", [](Node& n) { n.area->shape = AreaShape::disk; });
  edit("plain", [](Node& n) { n.area->picture = nullptr; });
  edit("another", [](Node& n) { n.area->picture = quarters(); });
}

TEST(LightPictures, AreSavedBesideTheScene) {
  const test::TemporaryFolder folder;
  const Lit lit;
  for (const char* name : {"s.gltf", "s.glb"}) {
    saveGltf(lit.scene, folder.path() / name);
    const LoadedScene loaded = loadGltf(folder.path() / name);
    EXPECT_EQ(test::difference(lit.scene, loaded.scene), "") << name;
    // Saved again, to another folder.
    std::filesystem::create_directories(folder.path() / "other");
    saveGltf(loaded.scene, folder.path() / "other" / name);
    EXPECT_EQ(test::difference(lit.scene, loadGltf(folder.path() / "other" / name).scene), "");
  }
  // If the picture file is missing, the light has no picture, and there is a warning.
  std::filesystem::remove(folder.path() / "quarters.png");
  const LoadedScene without = loadGltf(folder.path() / "s.gltf");
  EXPECT_FALSE(without.warnings.empty());
  EXPECT_EQ(without.scene.nodes.back().area->picture, nullptr);
}

TEST(LightPictures, FilesThatAreNoPictureAreRejectedWithOneLine) {
  const test::TemporaryFolder folder;
  writePng(Image8(2, 2), folder.path() / "white.png");
  EXPECT_NE(readLightPicture(folder.path() / "white.png"), nullptr);
  Image8 black(2, 2);
  std::fill(black.pixels.begin(), black.pixels.end(), uint8_t{0});
  writePng(black, folder.path() / "black.png");
  std::ofstream(folder.path() / "text.png") << "no picture";
  for (const char* name : {"black.png", "text.png", "gone.png"}) {
    try {
      readLightPicture(folder.path() / name);
      ADD_FAILURE() << name;
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << name;
    }
  }
}

}  // namespace
}  // namespace lamplighter
