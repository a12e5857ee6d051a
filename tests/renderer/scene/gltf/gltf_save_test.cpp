// A saved scene loads as the same scene, including edits and unknown extensions.
#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Row = std::map<std::string, std::string>;

// --- the collection ---

class SavedScene : public testing::TestWithParam<Row> {};

TEST_P(SavedScene, LoadsAsTheSameSceneFromAnotherFolder) {
  const Scene scene = loadGltf(test::sharedScenes() / GetParam().at("file")).scene;
  const test::TemporaryFolder folder;
  for (const char* name : {"again.glb", "again.gltf"}) {
    const fs::path path = folder.path() / name;
    saveGltf(scene, path);
    EXPECT_EQ(test::difference(scene, loadGltf(path).scene), "") << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SavedScene,
                         testing::ValuesIn(test::readTable(test::sharedScenes() / "scenes.tsv")),
                         [](const auto& scene) {
                           return test::testNameOf(scene.param.at("file"));
                         });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SavedScene);

TEST(SavedOddScene, LoadsAsTheSameScene) {
  const fs::path folder = test::sharedScenes() / "malformed";
  if (!fs::exists(folder)) GTEST_SKIP() << "no " << folder;
  const test::TemporaryFolder target;
  int saved = 0;
  for (const Row& row : test::readTable(folder / "cases.tsv")) {
    if (row.at("expect") == "error") continue;
    try {
      const Scene scene = loadGltf(folder / row.at("file")).scene;
      saveGltf(scene, target.path() / "odd.glb");
      EXPECT_EQ(test::difference(scene, loadGltf(target.path() / "odd.glb").scene), "")
          << row.at("file");
      ++saved;
    } catch (const InputError& e) {
      EXPECT_NE(row.at("expect"), "load") << e.what();
    }
  }
  EXPECT_GE(saved, 5);
}

// --- a generated scene, edited ---

class EditedScene : public testing::Test {
 protected:
  EditedScene() {
    std::string binary;
    json_ = test::everythingScene(binary);
    folder_.write("level.bin", binary);
    json_["buffers"][0]["uri"] = "level.bin";
    path_ = folder_.write("level.gltf", json_.dump());
    scene_ = loadGltf(path_).scene;
  }

  Node& node(const std::string& name) {
    for (Node& n : scene_.nodes) {
      if (n.name == name) return n;
    }
    ADD_FAILURE() << "no node " << name;
    return scene_.nodes.front();
  }
  void remove(const std::string& name) {
    const NodeId id = node(name).id;
    std::erase_if(scene_.nodes, [&](const Node& n) { return n.id == id || n.parent == id; });
  }
  Node& add(const std::string& name, NodeId parent = kNoNode) {
    Node n;
    n.id = scene_.nextId++;
    n.name = name;
    n.parent = parent;
    scene_.nodes.push_back(n);
    return scene_.nodes.back();
  }

  // Saves the scene as .glb, as .gltf in another folder and as .gltf beside its source, and
  // compares it after loading. Returns the JSON of the last file.
  Json expectRoundTrip() {
    saveGltf(scene_, other_.path() / "edited.glb");
    EXPECT_EQ(test::difference(scene_, loadGltf(other_.path() / "edited.glb").scene), "");
    saveGltf(scene_, other_.path() / "edited.gltf");
    EXPECT_EQ(test::difference(scene_, loadGltf(other_.path() / "edited.gltf").scene), "");
    saveGltf(scene_, folder_.path() / "edited.gltf");
    EXPECT_EQ(test::difference(scene_, loadGltf(folder_.path() / "edited.gltf").scene), "");
    return Json::parse(test::readText(folder_.path() / "edited.gltf"));
  }

  test::TemporaryFolder folder_, other_;
  Json json_;
  fs::path path_;
  Scene scene_;
};

TEST_F(EditedScene, WithoutEditsTheFileIsTheSame) {
  EXPECT_EQ(expectRoundTrip(), json_);
  EXPECT_FALSE(fs::exists(folder_.path() / "edited.bin")) << "there is no new binary data";
}

TEST_F(EditedScene, ContainsTheDataOfTheFile) {
  EXPECT_EQ(scene_.name, "the level");
  EXPECT_EQ(scene_.nodes.size(), 6u);
  EXPECT_EQ(node("floor").parent, node("root").id);
  ASSERT_TRUE(node("bulb").punctual.has_value());
  EXPECT_EQ(node("bulb").punctual->intensity, vec3(40, 20, 10));
  ASSERT_TRUE(node("lamp").area.has_value());
  EXPECT_EQ(node("lamp").area->shape, AreaShape::rectangle);
  EXPECT_EQ(node("lamp").area->radiance, vec3(15.0f, 13.5f, 12.0f));
  EXPECT_EQ(node("lamp").area->size, vec2(1.5f, 0.5f));
  EXPECT_EQ(scene_.materials[0].emissive, vec3(1.5f, 0, 0));
  EXPECT_EQ(scene_.materials[0].baseColorTexture.scale, vec2(2));
  EXPECT_EQ(scene_.textures[0].wrapS, Wrap::clamp);
  EXPECT_EQ(scene_.textures[0].wrapT, Wrap::mirror);
  EXPECT_TRUE(scene_.textures[0].nearest);
  const uint8_t* pixel = scene_.textures[0].image->at(0, 0);
  EXPECT_EQ(std::vector<int>(pixel, pixel + 4), (std::vector<int>{255, 128, 32, 255}));
  // The last two vertices of the strip come from sparse data.
  const Primitive& strip = scene_.meshes[1]->primitives[0];
  EXPECT_EQ(strip.indices.size(), 6u);
  EXPECT_EQ(scene_.meshes[0]->primitives[0].uv0[1], vec2(1.0f));
  EXPECT_EQ(scene_.cameras[0].yfov, 0.9f);
}

TEST_F(EditedScene, TransformsNamesAndVisibility) {
  node("floor").local.translation = vec3(0.1f, -0.2f, 1.0f / 3.0f);
  node("floor").name = "Boden";
  node("lamp").local.rotation = glm::normalize(quat(0.3f, 0.2f, 0.9f, 0.1f));
  node("lamp").local.scale = vec3(0.7f, 1.3f, 2.0f);
  node("eye").visible = false;
  node("root").local.scale = vec3(-1, 1, 1);
  const Json saved = expectRoundTrip();
  EXPECT_EQ(saved["nodes"][1]["name"], "Boden");
  EXPECT_EQ(saved["nodes"][1]["translation"], Json({0.1, -0.2, 0.33333334}));
  EXPECT_EQ(saved["nodes"][5]["extensions"]["KHR_node_visibility"]["visible"], false);
}

TEST_F(EditedScene, KindOfMesh) {
  node("floor").meshKind = MeshKind::complex;
  Json saved = expectRoundTrip();
  EXPECT_EQ(saved["nodes"][1]["extras"]["lamplighter"]["mesh"], "complex");
  saveGltf(scene_, path_);
  scene_ = loadGltf(path_).scene;
  EXPECT_EQ(scene_.nodes[1].meshKind, MeshKind::complex);
  scene_.nodes[1].meshKind = MeshKind::simple;
  saved = expectRoundTrip();
  EXPECT_EQ(saved["nodes"][1]["extras"]["lamplighter"]["mesh"], "simple");
  saveGltf(scene_, path_);
  scene_ = loadGltf(path_).scene;
  scene_.nodes[1].meshKind = MeshKind::automatic;
  saved = expectRoundTrip();
  EXPECT_EQ(saved["nodes"][1].dump().find("complex"), std::string::npos);
  EXPECT_EQ(saved["nodes"][1].dump().find("simple"), std::string::npos);
}

TEST_F(EditedScene, ShearIsKeptAsMatrix) {
  node("floor").local.shear = vec3(0.25f, 0.0f, 0.5f);
  saveGltf(scene_, path_);
  const Scene again = loadGltf(path_).scene;
  const Transform &a = node("floor").local, &b = again.nodes[1].local;
  const mat4 m = toMatrix(a), n = toMatrix(b);
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(m[c][r], n[c][r], 1e-6f);
  }
  EXPECT_GT(std::abs(b.shear.x), 0.1f);
}

TEST_F(EditedScene, LightsOfEveryKind) {
  node("bulb").punctual->intensity = vec3(0.1f, 7.3f, 1234.5f);
  Node& spot = add("spot");
  spot.punctual = PunctualLight{PunctualKind::spot, vec3(3, 2, 1), 12.5f, 0.2f, 0.7f};
  Node& sun = add("sun", node("root").id);
  sun.punctual = PunctualLight{PunctualKind::directional, vec3(0.3f)};
  Node& rectangle = add("rectangle", node("floor").id);  // the scale of the floor is (2, 1, 2)
  rectangle.area = AreaLight{AreaShape::rectangle, vec3(0.1f, 0.2f, 0.3f), vec2(0.37f, 1.9f)};
  Node& disk = add("disk");
  disk.area = AreaLight{AreaShape::disk, vec3(17, 12.3f, 9), vec2(0.81f)};
  for (const float diameter : {0.3f, 0.3f, 0.5f}) {
    Node& sphere = add("sphere");
    sphere.area = AreaLight{AreaShape::sphere, vec3(20.1f, 19, 2), vec2(diameter)};
    sphere.local.translation = vec3(diameter);
  }
  const Json saved = expectRoundTrip();
  EXPECT_EQ(saved["meshes"].size(), 4u) << "two additional meshes for spheres of two sizes";
  EXPECT_EQ(saved["materials"].size(), 2u);
  EXPECT_EQ(saved["extensions"]["XYZ_unheard_of"], json_["extensions"]["XYZ_unheard_of"]);
}

TEST_F(EditedScene, RepeatedSavingAddsNoSpheres) {
  Node& sphere = add("sphere");
  sphere.area = AreaLight{AreaShape::sphere, vec3(20), vec2(0.4f)};
  const fs::path path = other_.path() / "level.glb";
  saveGltf(scene_, path);
  const std::string once = test::readText(path);
  saveGltf(loadGltf(path).scene, path);
  saveGltf(loadGltf(path).scene, path);
  EXPECT_EQ(test::readText(path), once);
  // Saved over its source, with an additional buffer.
  saveGltf(scene_, path_);
  saveGltf(loadGltf(path_).scene, path_);
  saveGltf(loadGltf(path_).scene, path_);
  EXPECT_EQ(test::difference(scene_, loadGltf(path_).scene), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 3);  // .gltf and two .bin
  // After the sphere is deleted, none of its data is left.
  Scene without = loadGltf(path_).scene;
  without.nodes.pop_back();
  saveGltf(without, path_);
  EXPECT_EQ(Json::parse(test::readText(path_))["meshes"].size(), 2u);
}

TEST_F(EditedScene, AreaLightsFollowTheirParentsScale) {
  // EXT_lights_area scales by the largest axis only; the light must keep its size.
  node("lamp").local.scale = vec3(1, 2, 1);
  const Json saved = expectRoundTrip();
  const Json& light = saved["extensions"]["EXT_lights_area"]["lights"].back();
  EXPECT_NEAR(light["size"].get<double>(), 0.5, 1e-6);  // 0.5 × 2, of a largest scale of 2
  EXPECT_NEAR(light["rect"]["aspect"].get<double>(), 1.5, 1e-6);  // 1.5 × 1 to 0.5 × 2
}

TEST_F(EditedScene, DeletingUpdatesNodeIndices) {
  remove("bulb");  // a joint of the skin, target of an animation, the only node with light 0
  const Json saved = expectRoundTrip();
  ASSERT_EQ(saved["nodes"].size(), 6u);
  EXPECT_EQ(saved["nodes"][0]["children"], Json({1, 2}));
  EXPECT_EQ(saved["scenes"][0]["nodes"], Json({0, 3, 4}));
  EXPECT_EQ(saved["scenes"][1]["nodes"], Json({5, 0}));
  EXPECT_FALSE(saved.contains("skins"));
  EXPECT_FALSE(saved["nodes"][5].contains("skin"));
  EXPECT_EQ(saved["animations"][0]["channels"].size(), 1u);
  EXPECT_EQ(saved["animations"][0]["channels"][0]["target"]["node"], 3);
  const Json& lights = saved["extensions"]["KHR_lights_punctual"]["lights"];
  ASSERT_EQ(lights.size(), 1u) << "the unused light of the source file is kept";
  EXPECT_EQ(lights[0]["type"], "spot");
}

TEST_F(EditedScene, EverythingDeleted) {
  scene_.nodes.clear();
  scene_.sky = kDefaultSky;
  scene_.skyIsDefault = false;
  saveGltf(scene_, path_);
  const Scene again = loadGltf(path_).scene;
  EXPECT_TRUE(again.nodes.empty());
  EXPECT_EQ(again.meshes.size(), scene_.meshes.size());
}

TEST_F(EditedScene, DuplicatesKeepUnknownExtensions) {
  Node copy = node("bulb");
  copy.id = scene_.nextId++;
  copy.name = "bulb 2";
  copy.local.translation = vec3(5);
  scene_.nodes.push_back(copy);
  Node child = node("floor");
  child.id = scene_.nextId++;
  child.parent = copy.id;
  scene_.nodes.push_back(child);
  const Json saved = expectRoundTrip();
  ASSERT_EQ(saved["nodes"].size(), 9u);
  EXPECT_EQ(saved["nodes"][7]["extensions"]["XYZ_unheard_of"], Json({{"x", 1}}));
  EXPECT_EQ(saved["nodes"][7]["children"], Json({8}));
}

TEST_F(EditedScene, Reparenting) {
  node("eye").parent = node("root").id;
  node("strip").parent = kNoNode;
  node("root").parent = kNoNode;
  expectRoundTrip();
  // "root" is also a root of the other scene. As a child it cannot be a root there.
  const Node lamp = node("lamp");
  std::erase_if(scene_.nodes, [&](const Node& n) { return n.id == lamp.id; });
  scene_.nodes.insert(scene_.nodes.begin(), lamp);
  node("root").parent = lamp.id;
  const Json saved = expectRoundTrip();
  EXPECT_EQ(saved["scenes"][1]["nodes"], Json({6}));
}

TEST_F(EditedScene, MaterialsTexturesMeshesAndCameras) {
  Material& tiles = scene_.materials[0];
  tiles.baseColor = vec4(0.1f, 0.2f, 0.3f, 0.4f);
  tiles.emissive = vec3(0.7f, 12.3f, 4.56f);
  tiles.normalTexture = TextureRef{0, 1, vec2(0.1f, 0.2f), 0.3f, vec2(4, 5)};
  tiles.normalScale = 0.6f;
  tiles.roughness = 0.35f;
  tiles.metallicRoughnessTexture = TextureRef{1, 0, vec2(0.3f, 0.1f), 0.2f, vec2(2, 3)};
  tiles.alphaMode = AlphaMode::mask;
  tiles.alphaCutoff = 0.3f;
  tiles.doubleSided = false;
  auto image = std::make_shared<Image8>(3, 2);
  for (size_t i = 0; i < image->pixels.size(); ++i) image->pixels[i] = static_cast<uint8_t>(9 * i);
  scene_.textures.push_back(Texture{"new", image, Wrap::mirror, Wrap::clamp, true, false});
  Material glass;
  glass.name = "glass";
  glass.transmission = 0.9f;
  glass.baseColorTexture.texture = 1;
  scene_.materials.push_back(glass);
  auto box = std::make_shared<Mesh>(*test::boxMesh(vec3(1, 2, 3), 1));
  box->primitives[0].uv1.assign(box->primitives[0].positions.size(), vec2(0.25f));
  box->primitives[0].colors.assign(box->primitives[0].positions.size(), vec4(0.1f, 0.5f, 2, 1));
  scene_.meshes.push_back(box);
  add("box", node("lamp").id).mesh = 2;
  scene_.cameras[0].yfov = 1.1f;
  scene_.cameras.push_back(Camera{"close", 0.4f, 0.0f, 0.02f, 50.0f});
  add("camera").camera = 1;
  const Json saved = expectRoundTrip();
  EXPECT_EQ(saved["materials"][0]["occlusionTexture"], json_["materials"][0]["occlusionTexture"]);
  EXPECT_EQ(saved["materials"][0]["extensions"]["XYZ_unheard_of"], Json({{"y", 2}}));
}

TEST_F(EditedScene, AnotherMaterialKeepsTheMesh) {
  scene_.materials.push_back(Material{});
  auto mesh = std::make_shared<Mesh>(*scene_.meshes[0]);
  mesh->primitives[0].material = 1;
  scene_.meshes[0] = mesh;
  const Json saved = expectRoundTrip();
  EXPECT_EQ(saved["accessors"], json_["accessors"]) << "no vertex is written twice";
  EXPECT_EQ(saved["meshes"][0]["primitives"][0]["extras"], Json({{"kept", 1}}));
}

TEST(SavedNewScene, LoadsAsTheSameScene) {
  Scene scene;
  const int red = test::addMaterial(scene, vec3(0.8f, 0.1f, 0.1f));
  test::addMesh(scene, test::boxMesh(vec3(1), red), vec3(0, 1, 0));
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1, 0.5f), vec3(10, 9, 8));
  const test::TemporaryFolder folder;
  for (const char* name : {"new.glb", "new.gltf"}) {
    saveGltf(scene, folder.path() / name);
    const LoadedScene loaded = loadGltf(folder.path() / name);
    EXPECT_EQ(test::difference(scene, loaded.scene), "") << name;
    EXPECT_TRUE(loaded.warnings.empty());
  }
}

TEST(SavedNewScene, HasNoSky) {
  Scene scene;
  test::addMesh(scene, test::boxMesh(vec3(1)));
  scene.sky = kDefaultSky;
  scene.skyIsDefault = true;
  const test::TemporaryFolder folder;
  saveGltf(scene, folder.path() / "dark.gltf");
  EXPECT_EQ(test::readText(folder.path() / "dark.gltf").find("sky"), std::string::npos);
  EXPECT_TRUE(loadGltf(folder.path() / "dark.gltf").scene.skyIsDefault);
}

// --- the files ---

std::string refusal(const Scene& scene, const fs::path& path) {
  try {
    saveGltf(scene, path);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST_F(EditedScene, ForeignBuffersAreNotOverwritten) {
  folder_.write("new.bin", "somebody else's");
  add("sphere").area = AreaLight{AreaShape::sphere, vec3(20), vec2(0.4f)};
  saveGltf(scene_, folder_.path() / "new.gltf");
  EXPECT_EQ(test::readText(folder_.path() / "new.bin"), "somebody else's");
  EXPECT_EQ(test::difference(scene_, loadGltf(folder_.path() / "new.gltf").scene), "");
}

TEST_F(EditedScene, InvalidTargetsAreRejected) {
  EXPECT_THAT(refusal(scene_, folder_.path() / "level.obj"), HasSubstr(".gltf"));
  EXPECT_THAT(refusal(scene_, folder_.path() / "none" / "level.gltf"), HasSubstr("No such file"));
  EXPECT_THAT(refusal(scene_, path_ / "level.glb"), HasSubstr("Not a directory"));
  fs::create_directory(folder_.path() / "folder.glb");
  EXPECT_THAT(refusal(scene_, folder_.path() / "folder.glb"), HasSubstr("not a regular file"));
  fs::permissions(path_, fs::perms::owner_read);
  EXPECT_THAT(refusal(scene_, path_), HasSubstr("write-protected"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 3)
      << "no temporary file may remain";
}

// A limit on the file size simulates a full disk: write() fails in the middle.
TEST_F(EditedScene, FullDiskChangesNothing) {
  auto mesh = std::make_shared<Mesh>(*test::boxMesh(vec3(1)));
  mesh->primitives[0].uv1.assign(mesh->primitives[0].positions.size(), vec2(0.0f));
  saveGltf(scene_, other_.path() / "level.gltf");
  const std::string before = test::readText(other_.path() / "level.gltf"),
                    bytesBefore = test::readText(other_.path() / "level.bin");
  for (int i = 0; i < 200; ++i) add("lamp " + std::to_string(i)).area = AreaLight{};
  scene_.meshes.push_back(mesh);

  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = old;
  small.rlim_cur = before.size() + 1000;  // enough for the .bin file, not for the .gltf file
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = refusal(scene_, other_.path() / "level.gltf");
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);

  EXPECT_THAT(message, HasSubstr("level.gltf: cannot be written"));
  EXPECT_EQ(test::readText(other_.path() / "level.gltf"), before);
  EXPECT_EQ(test::readText(other_.path() / "level.bin"), bytesBefore);
  EXPECT_EQ(std::distance(fs::directory_iterator(other_.path()), {}), 2);
}

}  // namespace
}  // namespace lamplighter
