// The sky in files: a saved sky loads as the same sky, and a malformed one is ignored as a whole.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/scenes/skies.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using testing::HasSubstr;

Scene boxScene() {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(1), test::addMaterial(scene, vec3(0.5f))));
  return scene;
}

class SavedSky : public testing::Test {
 protected:
  test::TemporaryFolder folder_, other_;
  std::shared_ptr<const SkyImage> picture_ =
      test::throughFile(test::cloudySky().image->pixels, other_.path() / "clo udy.exr");
  const fs::path file_ = folder_.path() / "level.gltf";

  Json noteIn(const fs::path& file) const {
    return Json::parse(test::readText(file))["scenes"][0]["extras"]["lamplighter"]["sky"];
  }
  // Returns the scene after saving and loading.
  Scene roundTrip(const Scene& scene, const std::string& name) const {
    saveGltf(scene, folder_.path() / name);
    LoadedScene loaded = loadGltf(folder_.path() / name);
    EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings.front();
    return loaded.scene;
  }
};

TEST_F(SavedSky, OfEachKindLoadsFromBothFormats) {
  for (const Sky& sky : {Sky(vec3(0.1f, 0.2f, 0.3f)), test::gradientSky(), Sky(vec3(0.0f)),
                         Sky::picture(picture_, 0.4f, 2.5f)}) {
    for (const char* name : {"level.gltf", "level.glb"}) {
      Scene scene = boxScene();
      scene.source = loadGltf([&] {
                       saveGltf(boxScene(), other_.path() / "plain.gltf");
                       return other_.path() / "plain.gltf";
                     }())
                         .scene.source;  // it has the default sky, so a black sky is a change
      scene.sky = sky;
      const Scene back = roundTrip(scene, name);
      EXPECT_EQ(back.sky, sky) << name << " " << static_cast<int>(sky.kind);
      EXPECT_FALSE(back.skyIsDefault);
    }
  }
}

TEST_F(SavedSky, PicturesAreSavedBesideTheSceneOnce) {
  Scene scene = boxScene();
  scene.sky = Sky::picture(picture_);
  saveGltf(scene, file_);
  EXPECT_EQ(noteIn(file_)["uri"], "clo%20udy.exr");
  EXPECT_TRUE(fs::exists(folder_.path() / "clo udy.exr"));
  // Saved again, rotated, from the loaded and from the original scene: the picture file is the
  // same.
  Scene loaded = loadGltf(file_).scene;
  loaded.sky.rotation = 1.0f;
  saveGltf(loaded, file_);
  scene.sky.rotation = 0.5f;
  saveGltf(scene, file_);
  EXPECT_EQ(noteIn(file_)["rotation"], 0.5);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 3);  // .gltf, .bin, .exr
  // The picture is copied to another folder. A different file of the same name is kept.
  const fs::path elsewhere = other_.path() / "sub";
  fs::create_directory(elsewhere);
  std::ofstream(elsewhere / "clo udy.exr") << "another file";
  saveGltf(loadGltf(file_).scene, elsewhere / "copy.gltf");
  EXPECT_EQ(noteIn(elsewhere / "copy.gltf")["uri"], "clo%20udy-1.exr");
  EXPECT_EQ(test::readText(elsewhere / "clo udy.exr"), "another file");
  EXPECT_EQ(loadGltf(elsewhere / "copy.gltf").scene.sky, loadGltf(file_).scene.sky);
}

TEST_F(SavedSky, CanBeRemovedWithoutChangingOtherExtras) {
  Scene scene = boxScene();
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1), vec3(5));
  scene.sky = test::gradientSky();
  saveGltf(scene, file_);
  Json json = Json::parse(test::readText(file_));
  json["scenes"][0]["extras"]["mine"] = 7;
  folder_.write("level.gltf", json.dump());
  Scene loaded = loadGltf(file_).scene;
  EXPECT_EQ(loaded.sky, test::gradientSky());
  loaded.sky = Sky();
  saveGltf(loaded, file_);
  EXPECT_EQ(Json::parse(test::readText(file_))["scenes"][0]["extras"], Json({{"mine", 7}}));
  EXPECT_TRUE(loadGltf(file_).scene.sky.isBlack());
}

TEST_F(SavedSky, ABlackSkyIsSavedIfThereAreNoLights) {
  Scene scene = loadGltf([&] {
                  saveGltf(boxScene(), file_);
                  return file_;
                }())
                    .scene;
  ASSERT_TRUE(scene.skyIsDefault);
  scene.sky = Sky();
  scene.skyIsDefault = false;
  saveGltf(scene, file_);
  const LoadedScene back = loadGltf(file_);
  EXPECT_TRUE(back.scene.sky.isBlack());
  EXPECT_FALSE(back.scene.skyIsDefault);
}

TEST_F(SavedSky, MalformedOnesAreIgnoredWithOneWarning) {
  test::throughFile(test::cloudySky().image->pixels, folder_.path() / "fine.exr");
  folder_.write("text.exr", "no picture");
  saveGltf(boxScene(), file_);
  const Json plain = Json::parse(test::readText(file_));
  const auto warningsWith = [&](const char* note) {
    Json json = plain;
    json["scenes"][0]["extras"]["lamplighter"]["sky"] = Json::parse(note);
    folder_.write("level.gltf", json.dump());
    const LoadedScene loaded = loadGltf(file_);
    if (loaded.warnings.size() > 1) {
      EXPECT_TRUE(loaded.scene.skyIsDefault);  // nothing of the malformed sky is used
    }
    return loaded.warnings;
  };
  EXPECT_TRUE(warningsWith(R"({"type":"image","uri":"fine.exr"})").empty());
  const std::pair<const char*, const char*> cases[] = {
      {R"("blue")", "no known type"},
      {R"({})", "no known type"},
      {R"({"type":3})", "no known type"},
      {R"({"type":"cubemap"})", "no known type"},
      {R"({"type":"constant"})", "no radiance of three numbers"},
      {R"({"type":"constant","radiance":[1,2]})", "no radiance of three numbers"},
      {R"({"type":"constant","radiance":[1,2,"3"]})", "radiance that is not a number"},
      {R"({"type":"constant","radiance":[1,2,-3]})", "radiance out of range"},
      {R"({"type":"constant","radiance":[1,2,1e30]})", "radiance out of range"},
      {R"({"type":"gradient","zenith":[1,1,1],"horizon":[1,1,1]})", "no ground"},
      {R"({"type":"image"})", "names no picture"},
      {R"({"type":"image","uri":7})", "names no picture"},
      {R"({"type":"image","uri":"gone.exr"})", "does not exist"},
      {R"({"type":"image","uri":"text.exr"})", "no known image format"},
      {R"({"type":"image","uri":"../fine.exr"})", "outside"},
      {R"({"type":"image","uri":"/etc/passwd"})", "outside"},
      {R"({"type":"image","uri":"http://example.com/sky.exr"})", "outside"},
      {R"({"type":"image","uri":"fine.exr","rotation":"much"})", "rotation that is not a number"},
      {R"({"type":"image","uri":"fine.exr","scale":-1})", "scale out of range"},
  };
  for (const auto& [note, what] : cases) {
    const auto warnings = warningsWith(note);
    ASSERT_EQ(warnings.size(), 2u) << note;  // the other warning: the scene has no light
    EXPECT_THAT(warnings[0], HasSubstr(what)) << note;
    EXPECT_TRUE(warnings[0].starts_with(file_.string() + ": ")) << warnings[0];
  }
  // Saving keeps the malformed sky of the file.
  saveGltf(loadGltf(file_).scene, file_);
  EXPECT_EQ(noteIn(file_)["scale"], -1);
}

TEST(SkyFile, ThatIsNoPictureIsRejected) {
  const test::TemporaryFolder folder;
  for (const auto& [name, what] :
       {std::pair("gone.exr", "does not exist"), {"text.hdr", "no known image format"}}) {
    folder.write("text.hdr", "no picture");
    try {
      readSkyImage(folder.path() / name);
      ADD_FAILURE() << name;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(what));
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace lamplighter
