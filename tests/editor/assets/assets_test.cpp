// Assets: props placed from other files. All copies of a prop share its meshes.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "editor/assets/asset_folder.h"
#include "editor/assets/asset_library.h"
#include "editor/assets/thumbnail.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/gltf/referenced_files.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class Assets : public test::SessionFixture {
 protected:
  void SetUp() override {
    SessionFixture::SetUp();
    folder_ = fs::path(testing::TempDir()) /
              ("lamplighter_assets_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "kit/deep");
    saveGltf(prop(vec3(1, 0, 0)), folder_ / "kit/crate.glb");
    saveGltf(prop(vec3(0, 1, 0)), folder_ / "kit/deep/green crate.gltf");
    std::ofstream(folder_ / "kit/notes.txt") << "not a prop";
  }
  void TearDown() override { fs::remove_all(folder_); }

  // A textured box of two parts that stands 3 m beside its origin.
  static Scene prop(const vec3& colour) {
    Scene scene;
    auto image = std::make_shared<Image8>(4, 4);
    image->at(1, 1)[0] = 40;
    Texture texture;
    texture.image = std::move(image);
    scene.textures.push_back(std::move(texture));
    const int material = test::addMaterial(scene, colour);
    scene.materials[static_cast<size_t>(material)].baseColorTexture.texture = 0;
    const NodeId box = test::addMesh(scene, test::boxMesh(vec3(0.5f), material), vec3(3, 0.25f, 0));
    const NodeId lid = test::addMesh(scene, test::boxMesh(vec3(0.2f), material), vec3(3, 0.6f, 0));
    scene.find(box)->name = "box";
    scene.find(lid)->name = "lid";
    return scene;
  }
  bool place(const std::string& file) {
    return session_.runAction("asset.place \"" + (folder_ / "kit" / file).string() + "\"");
  }
  const Scene& scene() const { return session_.document().scene; }
  fs::path folder_;
};

TEST_F(Assets, AreListedAndSearched) {
  const auto files = listAssets(folder_ / "kit");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "crate");
  EXPECT_EQ(files[1].name, "deep/green crate");
  EXPECT_EQ(matchingAssets(files, "CRATE green").size(), 1u);
  EXPECT_EQ(matchingAssets(files, "").size(), 2u);
  EXPECT_THROW(listAssets(folder_ / "gone"), InputError);
}

TEST_F(Assets, CopiesShareTheirMeshes) {
  const uint64_t was = hash();
  const Scene before = scene();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(place("crate.glb")) << session_.status();
  EXPECT_EQ(scene().meshes.size(), before.meshes.size() + 2);
  EXPECT_EQ(scene().materials.size(), before.materials.size() + 1);
  EXPECT_EQ(scene().textures.size(), before.textures.size() + 1);
  // Each copy is a group with two objects.
  EXPECT_EQ(scene().nodes.size(), before.nodes.size() + 150);
  for (int i = 0; i < 50; ++i) session_.undo();
  EXPECT_EQ(hash(), was);
  EXPECT_EQ(scene().meshes.size(), before.meshes.size());
  session_.redo();
  EXPECT_EQ(scene().meshes.size(), before.meshes.size() + 2);
}

TEST_F(Assets, EqualTexturesOfDifferentFilesAreShared) {
  ASSERT_TRUE(place("crate.glb"));
  const size_t textures = scene().textures.size();
  ASSERT_TRUE(place("deep/green crate.gltf"));
  EXPECT_EQ(scene().textures.size(), textures) << "both files have the same pixels";
}

TEST_F(Assets, StandOnTheClickedSurface) {
  ASSERT_TRUE(session_.runAction("asset.folder \"" + (folder_ / "kit").string() + "\""));
  EXPECT_EQ(session_.home().assetFiles.size(), 2u);
  ASSERT_TRUE(session_.runAction("place.start asset.place crate.glb"));
  press(pixelOf(vec3(-2, 0, 0)));
  release();
  const NodeId id = session_.document().active();
  EXPECT_TRUE(node(id).name.starts_with("crate ")) << node(id).name;
  EXPECT_NEAR(placeOf(id).x, -2.0f, 0.05f);
  EXPECT_NEAR(placeOf(id).y, 0.0f, 0.01f) << "its lowest point is on the floor";
  EXPECT_FALSE(session_.placing());
  session_.undo();
  EXPECT_EQ(scene().find(id), nullptr);
}

TEST_F(Assets, AreSavedOnceWithTheLevel) {
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(place("crate.glb"));
  fs::create_directories(folder_ / "level");
  session_.save(folder_ / "level/three.gltf");
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(place("crate.glb"));
  session_.save(folder_ / "level/many.gltf");
  const auto bytes = [&](const char* name) { return fs::file_size(folder_ / "level" / name); };
  EXPECT_EQ(bytes("three.bin"), bytes("many.bin")) << "geometry and pixels are stored once";
  // The saved level does not need the asset folder.
  fs::remove_all(folder_ / "kit");
  const LoadedScene loaded = loadGltf(folder_ / "level/many.gltf");
  EXPECT_EQ(loaded.scene.meshes.size(), scene().meshes.size());
  ASSERT_EQ(loaded.scene.textures.size(), scene().textures.size());
  EXPECT_FALSE(loaded.scene.textures.back().placeholder);
  EXPECT_EQ(loaded.scene.textures.back().image->pixels, scene().textures.back().image->pixels);
}

TEST_F(Assets, UnreadableFilesDoNotChangeTheLevel) {
  const uint64_t was = hash();
  std::ofstream(folder_ / "kit/broken.glb") << "not glTF";
  std::ofstream(folder_ / "kit/empty.gltf") << R"({"asset":{"version":"2.0"}})";
  for (const char* file : {"broken.glb", "gone.glb", "empty.gltf", "notes.txt"})
    EXPECT_FALSE(place(file)) << file;
  EXPECT_FALSE(session_.runAction("asset.folder /nowhere/at/all"));
  EXPECT_EQ(hash(), was);
}

TEST_F(Assets, AChangedFileIsReadAgain) {
  ASSERT_TRUE(place("crate.glb"));
  const size_t materials = scene().materials.size();
  saveGltf(prop(vec3(0, 0, 1)), folder_ / "kit/crate.glb");
  fs::last_write_time(folder_ / "kit/crate.glb",
                      fs::file_time_type::clock::now() + std::chrono::seconds(5));
  ASSERT_TRUE(place("crate.glb"));
  EXPECT_EQ(scene().materials.size(), materials + 1);
}

TEST_F(Assets, ThumbnailsHaveATransparentBackgroundAndAreCached) {
  const fs::path file = folder_ / "kit/crate.glb";
  const Image8 image = renderThumbnail(file, 48);
  ASSERT_EQ(image.width, 48);
  EXPECT_EQ(image.at(0, 0)[3], 0);
  const uint8_t* middle = image.at(24, 24);
  EXPECT_EQ(middle[3], 255);
  EXPECT_GT(middle[0], middle[1] + 40) << "the prop is red";
  const fs::path cache = folder_ / "cache";
  EXPECT_EQ(cachedThumbnail(file, 48, cache).pixels, image.pixels);
  ASSERT_EQ(std::distance(fs::directory_iterator(cache), fs::directory_iterator()), 1);
  // The key of the cache is the content, so a copy of the file uses the same thumbnail.
  fs::copy_file(file, folder_ / "kit/copy.glb");
  cachedThumbnail(folder_ / "kit/copy.glb", 48, cache);
  EXPECT_EQ(std::distance(fs::directory_iterator(cache), fs::directory_iterator()), 1);
  // A damaged thumbnail is rendered again.
  std::ofstream(fs::directory_iterator(cache)->path()) << "not a picture";
  EXPECT_EQ(cachedThumbnail(file, 48, cache).pixels, image.pixels);
  EXPECT_THROW(cachedThumbnail(folder_ / "kit/notes.txt", 48, cache), InputError);
}

// The .gltf file itself does not change when a texture file changes.
TEST_F(Assets, AreReadAgainWhenAReferencedFileChanges) {
  const fs::path file = folder_ / "kit/deep/green crate.gltf";
  const std::vector<FileStamp> beside = referencedFiles(file);
  ASSERT_FALSE(beside.empty());
  ASSERT_TRUE(referencedFiles(folder_ / "kit/crate.glb").empty());
  const fs::path cache = folder_ / "cache";
  const auto pictures = [&] {
    return std::distance(fs::directory_iterator(cache), fs::directory_iterator());
  };
  AssetLibrary library;
  const auto first = library.load(file);
  cachedThumbnail(file, 48, cache);
  cachedThumbnail(file, 48, cache);
  EXPECT_EQ(pictures(), 1);
  EXPECT_EQ(library.load(file), first);
  fs::last_write_time(beside.front().path,
                      fs::file_time_type::clock::now() + std::chrono::hours(1));
  cachedThumbnail(file, 48, cache);
  EXPECT_EQ(pictures(), 2);
  EXPECT_NE(library.load(file), first);
}

}  // namespace
}  // namespace lamplighter
