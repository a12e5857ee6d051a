// Malformed and unusual files: each one loads or is rejected with one line that gives the reason.
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scene_equality.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;
using Row = std::map<std::string, std::string>;

// The error message of loading, or "" if the file loads.
std::string refusal(const std::filesystem::path& path,
                    std::vector<std::string>* warnings = nullptr) {
  try {
    const LoadedScene loaded = loadGltf(path);
    if (warnings != nullptr) *warnings = loaded.warnings;
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

void expectOneLine(const std::string& message, const std::filesystem::path& path) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
}

// --- the collection ---

class MalformedFile : public testing::TestWithParam<Row> {};

TEST_P(MalformedFile, LoadsOrIsRejectedAsExpected) {
  const std::filesystem::path path = test::sharedScenes() / "malformed" / GetParam().at("file");
  ASSERT_TRUE(std::filesystem::exists(path));
  std::vector<std::string> warnings;
  const std::string message = refusal(path, &warnings);
  const std::string expect = GetParam().at("expect");
  if (expect == "error") {
    EXPECT_NE(message, "") << "loaded, but must be rejected";
  }
  if (expect == "load") {
    EXPECT_EQ(message, "");
  }
  if (!message.empty()) {
    expectOneLine(message, path);
    EXPECT_THAT(message, HasSubstr("; ")) << "must say what to do";
  }
  for (const std::string& warning : warnings) expectOneLine(warning, path);
}

std::string testName(const testing::TestParamInfo<Row>& info) {
  const std::string& file = info.param.at("file");
  return test::testNameOf(file.substr(0, file.find('/')));
}

INSTANTIATE_TEST_SUITE_P(All, MalformedFile,
                         testing::ValuesIn(test::readTable(test::sharedScenes() / "malformed" /
                                                           "cases.tsv")),
                         testName);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(MalformedFile);

TEST(GltfMessages, NameTheExtensionThatIsMissing) {
  const auto folder = test::sharedScenes() / "malformed";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  EXPECT_THAT(refusal(folder / "gltftransform-draco/BoxDraco.gltf"),
              HasSubstr("KHR_draco_mesh_compression"));
  EXPECT_THAT(refusal(folder / "gltftransform-meshopt/BoxMeshopt.glb"),
              HasSubstr("EXT_meshopt_compression"));
}

TEST(GltfMessages, NameMissingTextures) {
  const auto folder = test::sharedScenes() / "malformed";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  std::vector<std::string> warnings;
  refusal(folder / "validator-image-not-found/not_found.gltf", &warnings);
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("not_found.png")));
  refusal(folder / "ktx2-barn-lamp/AnisotropyBarnLamp.gltf", &warnings);
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("ktx2")));
}

// --- generated files, each broken in one way ---

class BrokenScene : public testing::Test {
 protected:
  BrokenScene() : json_(test::everythingScene(binary_)) {}

  std::filesystem::path write() {
    return folder_.write("scene.glb", test::glb(json_.dump(), binary_));
  }
  std::string refusalOf(const std::string& pointer, const Json& value) {
    json_[Json::json_pointer(pointer)] = value;
    return refusal(write());
  }

  test::TemporaryFolder folder_;
  std::string binary_;
  Json json_;
};

TEST_F(BrokenScene, IsValidUntilBroken) { EXPECT_EQ(refusal(write()), ""); }

TEST_F(BrokenScene, NamesWhatIsWrong) {
  struct Case {
    const char* pointer;
    Json value;
    const char* says;
  };
  const std::vector<Case> cases = {
      {"/asset/version", "3.0", "3.0"},
      {"/asset", 5, "asset.version"},
      {"/extensionsRequired", {"XYZ_unheard_of"}, "XYZ_unheard_of"},
      {"/extensionsRequired", "XYZ", "extensionsRequired"},
      {"/nodes", 3, "\"nodes\""},
      {"/nodes/0/children", {1, 2, 99}, "nodes[0]"},
      {"/nodes/0/children", {0}, "nodes[0]"},
      {"/nodes/1/children", {3}, "nodes[3]"},
      {"/nodes/1/children", {-1}, "nodes[1]"},
      {"/nodes/3/children", {0}, "cycle"},
      {"/nodes/1/mesh", 2, "nodes[1]"},
      {"/nodes/1/mesh", "square", "nodes[1]"},
      {"/nodes/5/camera", 7, "nodes[5]"},
      {"/nodes/6/skin", 1, "nodes[6]"},
      {"/nodes/2/matrix/5", nullptr, "nodes[2]"},
      {"/nodes/2/matrix/5", 1e300, "nodes[2]"},
      {"/nodes/2/matrix", {1, 2, 3}, "nodes[2]"},
      {"/nodes/0/translation", {1e30, 0, 0}, "nodes[0]"},
      {"/nodes/1/rotation", {0, 0, 0, 0}, "nodes[1]"},
      {"/nodes/3/extensions/KHR_lights_punctual/light", 2, "nodes[3]"},
      {"/nodes/4/extensions/EXT_lights_area/light", 2, "nodes[4]"},
      {"/scene", 2, "scene"},
      {"/scenes/0/nodes", {1}, "scenes[0]"},
      {"/scenes/0/nodes", {0, 0}, "scenes[0]"},
      {"/meshes/0/primitives/0/attributes/POSITION", 70, "meshes[0]"},
      {"/meshes/0/primitives/0/attributes/NORMAL", 3, "meshes[0]"},
      {"/meshes/0/primitives/0/indices", 0, "accessors[0]"},
      {"/meshes/0/primitives/0/material", 1, "meshes[0]"},
      {"/meshes/0/primitives/0/mode", 9, "meshes[0]"},
      {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", 1, "materials[0]"},
      {"/materials/0/emissiveFactor", {1, 2}, "materials[0]"},
      {"/textures/0/source", 3, "textures[0]"},
      {"/textures/0/sampler", 3, "textures[0]"},
      {"/images/0/bufferView", 30, "images[0]"},
      {"/bufferViews/3/buffer", 1, "bufferViews[3]"},
      {"/bufferViews/3/byteLength", 1u << 30, "bufferViews[3]"},
      {"/bufferViews/3/byteOffset", 18446744073709551615u, "bufferViews[3]"},
      {"/bufferViews/0/byteStride", 0, "bufferViews[0]"},
      {"/bufferViews/0/byteStride", 8, "accessors[0]"},
      {"/bufferViews/0/byteStride", 14, "multiple of 4"},
      {"/buffers/0/byteLength", 4294967296u, "buffers[0]"},
      {"/buffers/0/uri", "data:application/octet-stream;base64,@@@@", "buffers[0]"},
      {"/accessors/0/count", 4000000000u, "accessors[0]"},
      {"/accessors/0/componentType", 5124, "accessors[0]"},
      {"/accessors/0/type", "VEC5", "accessors[0]"},
      {"/accessors/0/byteOffset", 4, "accessors[0]"},
      {"/accessors/4/sparse/count", 3, "accessors[4]"},
      {"/accessors/4/sparse/indices/componentType", 5126, "accessors[4]"},
      {"/accessors/4/count", 2, "accessors[4]"},
      {"/accessors/3",
       {{"componentType", 5125}, {"type", "SCALAR"}, {"count", 4000000000u}},
       "accessors[3]"},
      {"/accessors/3",
       {{"componentType", 5123}, {"type", "SCALAR"}, {"count", 6}},
       "indices without a bufferView"},
      {"/materials/0/name", 7, "materials[0] has \"name\": 7, which is not a string"},
      {"/materials/0/normalTexture", {{"index", 0}, {"scale", "x"}}, "\"scale\""},
      {"/materials/0/doubleSided", 1, "true or false"},
      {"/meshes/0/primitives", {{"attributes", 0}}, "meshes[0]"},
      {"/meshes/0/primitives/0/attributes", Json::array({0}), "which is not an object"},
      {"/nodes/0/extras/lamplighter/light", {{"leaves_out", {99}}}, "leaves_out"},
      {"/extensions/KHR_lights_punctual/lights/0", 3, "KHR_lights_punctual.lights"},
      {"/extensions/KHR_lights_punctual/lights/0/color", {1, 2}, "KHR_lights_punctual.lights[0]"},
      {"/skins/0/joints", {44}, "skins[0]"},
      {"/animations/0/channels/0/target/node", 44, "animations[0]"},
      {"/animations/0/channels/0/sampler", 4, "animations[0]"},
  };
  const Json sound = json_;
  for (const Case& broken : cases) {
    json_ = sound;
    const std::string message = refusalOf(broken.pointer, broken.value);
    SCOPED_TRACE(std::string(broken.pointer) + " = " + broken.value.dump());
    EXPECT_THAT(message, HasSubstr(broken.says));
    if (!message.empty()) expectOneLine(message, folder_.path() / "scene.glb");
  }
}

// Some exporters write counts with a decimal point.
TEST_F(BrokenScene, CountsMayBeWrittenAsFloats) {
  const Scene before = loadGltf(write()).scene;
  for (Json& node : json_["nodes"]) {
    if (node.contains("mesh")) node["mesh"] = node["mesh"].get<double>();
  }
  for (Json& accessor : json_["accessors"]) {
    for (const char* key : {"bufferView", "count", "componentType"}) {
      if (accessor.contains(key)) accessor[key] = accessor[key].get<double>();
    }
  }
  ASSERT_THAT(json_.dump(), HasSubstr("\"count\":4.0"));
  EXPECT_EQ(test::difference(before, loadGltf(write()).scene), "");
}

TEST_F(BrokenScene, NonFinitePositionsAreRejected) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(&binary_[4], &nan, 4);
  EXPECT_THAT(refusal(write()), HasSubstr("meshes[0]"));
}

TEST_F(BrokenScene, IndicesOutOfRangeAreRejected) {
  const size_t indices = json_["bufferViews"][3]["byteOffset"];
  binary_[indices + 2] = 4;
  EXPECT_THAT(refusal(write()), HasSubstr("vertex index 4"));
}

TEST_F(BrokenScene, MissingBufferIsNamed) {
  json_["buffers"][0]["uri"] = "gone.bin";
  EXPECT_THAT(refusal(folder_.write("scene.gltf", json_.dump())), HasSubstr("gone.bin"));
  json_["buffers"][0].erase("uri");
  EXPECT_THAT(refusal(folder_.write("scene.gltf", json_.dump())), HasSubstr("buffers[0]"));
}

TEST_F(BrokenScene, FilesOutsideTheFolderAreNotRead) {
  // The file exists and is valid, but is rejected because of its folder.
  const auto outside = folder_.write("secret.bin", binary_);
  std::filesystem::create_directories(folder_.path() / "level");
  std::filesystem::create_symlink(outside, folder_.path() / "level" / "link.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), outside.string(),
        std::string("a/../../secret.bin"), "file://" + outside.string(), std::string("link.bin")}) {
    json_["buffers"][0]["uri"] = uri;
    EXPECT_THAT(refusal(folder_.write("level/scene.gltf", json_.dump())), HasSubstr("outside"))
        << uri;
  }
  folder_.write("level/inside.bin", binary_);
  json_["buffers"][0]["uri"] = "../level/./inside.bin";
  EXPECT_EQ(refusal(folder_.write("level/scene.gltf", json_.dump())), "");
}

TEST_F(BrokenScene, EveryTruncationIsRejected) {
  const std::string whole = test::glb(json_.dump(), binary_);
  for (size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    EXPECT_NE(refusal(folder_.write("cut.glb", whole.substr(0, size))), "") << size << " bytes";
  }
}

// Every file that loads can be edited, saved and loaded again.
void expectSavable(const std::filesystem::path& path, const std::filesystem::path& target) {
  Scene scene = loadGltf(path).scene;
  if (!scene.nodes.empty()) {
    const NodeId last = scene.nodes.back().id;
    std::erase_if(scene.nodes, [&](const Node& n) { return n.id == last || n.parent == last; });
  }
  for (Node& node : scene.nodes) {
    // A matrix with shear does not survive saving without rounding errors, so such a node is not
    // moved.
    if (node.local.shear == vec3(0.0f)) node.local.translation.x += 1.0f;
    if (node.punctual) node.punctual->intensity += vec3(1.0f);
    if (node.area) node.area->radiance += vec3(1.0f);
  }
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::sphere}) {
    Node lamp;
    lamp.id = scene.nextId++;
    lamp.name = "lamp";
    lamp.area = AreaLight{shape, vec3(3.0f), vec2(0.5f)};
    lamp.visible = false;
    lamp.punctual = PunctualLight{};
    scene.nodes.push_back(lamp);
  }
  for (Material& material : scene.materials) material.emissive += vec3(2.0f);
  saveGltf(scene, target);
  EXPECT_EQ(test::difference(scene, loadGltf(target).scene), "");
}

TEST_F(BrokenScene, FlippedBitsLoadOrAreRejected) {
  const std::string whole = test::glb(json_.dump(), binary_);
  std::mt19937 random(20261121);
  int loaded = 0, refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::string bytes = whole;
    for (uint32_t flips = 1 + random() % 3; flips > 0; --flips) {
      bytes[random() % bytes.size()] ^= static_cast<char>(1u << (random() % 8));
    }
    const auto path = folder_.write("flipped.glb", bytes);
    const std::string message = refusal(path);  // any other exception fails the test
    if (!message.empty()) expectOneLine(message, path);
    if (message.empty()) {
      SCOPED_TRACE(trial);
      EXPECT_NO_THROW(expectSavable(path, folder_.path() / "saved.glb"));
    }
    ++(message.empty() ? loaded : refused);
  }
  EXPECT_GT(loaded, 20);
  EXPECT_GT(refused, 20);
}

// Values of the wrong type or size, at any place in the JSON.
TEST_F(BrokenScene, WrongValuesLoadOrAreRejected) {
  const Json flat = json_.flatten();
  const std::vector<Json> odd = {
      nullptr,        -1,   1e38, 4294967295u,          "", Json::array(),
      Json::object(), true, 0,    18446744073709551615u};
  const Json sound = json_;
  int refused = 0, trials = 0;
  for (const auto& [pointer, value] : flat.items()) {
    // Replaces the containers above the value as well.
    for (Json::json_pointer at(pointer); !at.empty(); at = at.parent_pointer()) {
      json_ = sound;
      json_[at] = odd[static_cast<size_t>(trials++) % odd.size()];
      const auto path = folder_.write("odd.glb", test::glb(json_.dump(), binary_));
      const std::string message = refusal(path);
      if (!message.empty()) expectOneLine(message, path);
      refused += message.empty() ? 0 : 1;
      if (!message.empty()) continue;
      SCOPED_TRACE(at.to_string() + " = " + json_[at].dump());
      EXPECT_NO_THROW(expectSavable(path, folder_.path() / "saved.glb"));
    }
  }
  EXPECT_GT(trials, 500);
  EXPECT_GT(refused, trials / 4);
}

// --- extensions ---

class Extensions : public BrokenScene {
 protected:
  std::string refusalOf(const char* list, const Json& names) {
    json_["extensionsUsed"] = names;
    json_[list] = names;
    return refusal(write(), &warnings_);
  }
  std::vector<std::string> warnings_;
};

TEST_F(Extensions, RequiredUnknownOnesAreRejectedByName) {
  for (const char* name :
       {"VENDOR_unknown", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
        "EXT_mesh_gpu_instancing", "KHR_materials_unheard_of", "EXT_texture_unheard_of"}) {
    const std::string message = refusalOf("extensionsRequired", Json::array({name}));
    EXPECT_THAT(message, HasSubstr(std::string("needs the extension ") + name)) << name;
    expectOneLine(message, folder_.path() / "scene.glb");
  }
}

TEST_F(Extensions, RequiredMaterialExtensionsGiveAWarning) {
  for (const char* name :
       {"KHR_materials_anisotropy", "KHR_materials_clearcoat", "KHR_materials_dispersion",
        "KHR_materials_diffuse_transmission", "KHR_materials_ior", "KHR_materials_iridescence",
        "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sheen", "KHR_materials_specular",
        "KHR_materials_unlit", "KHR_materials_variants", "KHR_materials_volume",
        "KHR_texture_basisu"}) {
    ASSERT_EQ(refusalOf("extensionsRequired", Json::array({name})), "");
    ASSERT_THAT(warnings_,
                testing::ElementsAre(HasSubstr(std::string("needs the extension ") + name)));
    expectOneLine(warnings_.front(), folder_.path() / "scene.glb");
  }
}

TEST_F(Extensions, UsedMaterialExtensionsGiveOneWarning) {
  const Json names = {"KHR_materials_sheen", "KHR_materials_ior", "VENDOR_unknown",
                      "KHR_materials_unlit"};
  ASSERT_EQ(refusalOf("extensionsUsed", names), "");
  EXPECT_THAT(warnings_, testing::ElementsAre(HasSubstr(
                             "is shown without KHR_materials_sheen, KHR_materials_unlit: ")));
}

TEST_F(Extensions, SupportedOnesGiveNoWarning) {
  const Json names = {"KHR_lights_punctual",
                      "KHR_materials_emissive_strength",
                      "KHR_materials_transmission",
                      "KHR_mesh_quantization",
                      "KHR_node_visibility",
                      "KHR_texture_transform",
                      "EXT_lights_area",
                      "EXT_texture_webp"};
  ASSERT_EQ(refusalOf("extensionsRequired", names), "");
  EXPECT_THAT(warnings_, testing::IsEmpty());
}

// Unknown extensions and extras are saved unchanged at all places.
TEST_F(Extensions, SurviveARoundTrip) {
  const Json odd = {{"b", {1, 2.5, -0.0}}, {"a", {{"x", "\u00e9"}}}};
  const auto lists = {"nodes",    "meshes",   "materials", "accessors", "bufferViews",
                      "textures", "samplers", "cameras",   "scenes"};
  for (const char* list : lists) {
    json_[list][0]["extensions"]["VENDOR_odd"] = odd;
    json_[list][0]["extras"]["odd"] = odd;
  }
  Scene scene = loadGltf(write()).scene;
  scene.nodes[0].local.translation.x += 1.0f;
  saveGltf(scene, folder_.path() / "saved.gltf");
  std::ifstream file(folder_.path() / "saved.gltf");
  const Json saved = Json::parse(file);
  for (const char* list : lists) {
    EXPECT_EQ(saved[list][0]["extensions"]["VENDOR_odd"].dump(), odd.dump()) << list;
    EXPECT_EQ(saved[list][0]["extras"]["odd"].dump(), odd.dump()) << list;
  }
}

TEST(BrokenJson, DeepNestingIsRejected) {
  const test::TemporaryFolder folder;
  const std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') +
                           std::string(100000, ']') + "}";
  EXPECT_THAT(refusal(folder.write("deep.gltf", deep)), HasSubstr("nests"));
}

TEST(BrokenJson, OtherFilesAreRejected) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.path()), HasSubstr("folder"));
  EXPECT_THAT(refusal(folder.path() / "none.glb"), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(folder.write("text.gltf", "hello")), HasSubstr("not glTF"));
  EXPECT_THAT(refusal(folder.write("half.gltf", R"({"asset":{"vers)")), HasSubstr("JSON"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("not a regular file"));
}

// A chain of a hundred thousand nodes is valid. Recursion would overflow the stack.
TEST(OddScene, DeepChainOfNodesLoads) {
  constexpr int kNodes = 100000;
  Json json = {{"asset", {{"version", "2.0"}}}, {"scenes", Json::array()}};
  json["scenes"].push_back({{"nodes", {0}}});
  for (int i = 0; i < kNodes; ++i) {
    Json node = {{"name", "n"}};
    if (i + 1 < kNodes) node["children"] = {i + 1};
    json["nodes"].push_back(std::move(node));
  }
  const test::TemporaryFolder folder;
  const LoadedScene loaded = loadGltf(folder.write("chain.gltf", json.dump()));
  EXPECT_EQ(loaded.scene.nodes.size(), static_cast<size_t>(kNodes));
  EXPECT_EQ(worldMatrices(loaded.scene).size(), static_cast<size_t>(kNodes));
  saveGltf(loaded.scene, folder.path() / "again.gltf");
  EXPECT_EQ(loadGltf(folder.path() / "again.gltf").scene.nodes, loaded.scene.nodes);
}

// A thousand meshes that use one accessor: a few kilobytes would need gigabytes.
TEST(OddScene, MoreVerticesThanTheFileCanHoldAreRejected) {
  std::string binary(12 << 20, '\x3f');
  Json json = {{"asset", {{"version", "2.0"}}}};
  json["buffers"].push_back({{"byteLength", binary.size()}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", binary.size()}});
  json["accessors"].push_back({{"bufferView", 0},
                               {"componentType", 5126},
                               {"type", "VEC3"},
                               {"count", binary.size() / 12}});
  Json primitive = {{"attributes", {{"POSITION", 0}, {"NORMAL", 0}}}};
  Json mesh;
  for (int i = 0; i < 1000; ++i) mesh["primitives"].push_back(primitive);
  json["meshes"].push_back(mesh);
  const test::TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.write("many.glb", test::glb(json.dump(), binary))),
              HasSubstr("more vertices than"));
}

TEST(GltfProgress, ReturningFalseCancels) {
  const test::TemporaryFolder folder;
  std::string binary;
  const auto json = test::everythingScene(binary);
  const auto path = folder.write("scene.glb", test::glb(json.dump(), binary));
  float last = -1.0f;
  loadGltf(path, [&](float done, const std::string&) {
    EXPECT_GE(done, last);
    last = done;
    return true;
  });
  EXPECT_EQ(last, 1.0f);
  try {
    loadGltf(path, [](float, const std::string&) { return false; });
    FAIL() << "not cancelled";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "cancelled");
  }
}

}  // namespace
}  // namespace lamplighter
