// Other programs can read saved files: tinygltf, an independent reader, finds the same triangles at
// the same positions in every scene of the collection after an edit.
#include <cstring>

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/gltf_files.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

using Row = std::map<std::string, std::string>;

struct Content {
  size_t triangles = 0;
  Bounds bounds;  // world space
};

bool isTriangles(const tinygltf::Primitive& p) { return p.mode == -1 || p.mode == 4; }

void addPrimitive(Content& content, const tinygltf::Model& m, const tinygltf::Primitive& p,
                  const mat4& world) {
  const tinygltf::Accessor& positions =
      m.accessors.at(static_cast<size_t>(p.attributes.at("POSITION")));
  const tinygltf::Accessor& counted =
      p.indices < 0 ? positions : m.accessors.at(static_cast<size_t>(p.indices));
  content.triangles += counted.count / 3;
  // Only float positions, the one kind in the collection without sparse values.
  if (positions.bufferView < 0 || positions.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
  const tinygltf::BufferView& view = m.bufferViews.at(static_cast<size_t>(positions.bufferView));
  const auto stride = static_cast<size_t>(positions.ByteStride(view));
  const auto& bytes = m.buffers.at(static_cast<size_t>(view.buffer)).data;
  for (size_t i = 0; i < positions.count; ++i) {
    vec3 v;
    std::memcpy(&v, &bytes.at(view.byteOffset + positions.byteOffset + i * stride), sizeof v);
    content.bounds.add(vec3(world * vec4(v, 1.0f)));
  }
}

mat4 localMatrix(const tinygltf::Node& n) {
  if (n.matrix.size() == 16) {
    mat4 m;
    for (int i = 0; i < 16; ++i)
      m[i / 4][i % 4] = static_cast<float>(n.matrix[static_cast<size_t>(i)]);
    return m;
  }
  const auto at = [](const std::vector<double>& v, size_t i, double fallback) {
    return static_cast<float>(v.size() > i ? v[i] : fallback);
  };
  mat4 m(1.0f);
  m[3] = vec4(at(n.translation, 0, 0), at(n.translation, 1, 0), at(n.translation, 2, 0), 1.0f);
  m *= glm::mat4_cast(
      quat(at(n.rotation, 3, 1), at(n.rotation, 0, 0), at(n.rotation, 1, 0), at(n.rotation, 2, 0)));
  mat4 scale(1.0f);
  for (int i = 0; i < 3; ++i) scale[i][i] = at(n.scale, static_cast<size_t>(i), 1);
  return m * scale;
}

void addNode(Content& content, const tinygltf::Model& m, int index, const mat4& parent) {
  const tinygltf::Node& n = m.nodes.at(static_cast<size_t>(index));
  const mat4 world = parent * localMatrix(n);
  if (n.mesh >= 0) {
    for (const tinygltf::Primitive& p : m.meshes.at(static_cast<size_t>(n.mesh)).primitives) {
      if (isTriangles(p)) addPrimitive(content, m, p, world);
    }
  }
  for (const int child : n.children) addNode(content, m, child, world);
}

Content contentOf(const tinygltf::Model& m) {
  Content content;
  const size_t scene = m.defaultScene < 0 ? 0 : static_cast<size_t>(m.defaultScene);
  for (const int root : m.scenes.at(scene).nodes) addNode(content, m, root, mat4(1.0f));
  return content;
}

Content contentOf(const Scene& scene) {
  Content content;
  const std::vector<mat4> world = worldMatrices(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh == kNone) continue;
    for (const Primitive& p : scene.meshes[static_cast<size_t>(scene.nodes[i].mesh)]->primitives) {
      content.triangles += p.indices.size() / 3;
      for (const vec3& v : p.positions) content.bounds.add(vec3(world[i] * vec4(v, 1.0f)));
    }
  }
  return content;
}

tinygltf::Model readByTinygltf(const std::filesystem::path& path) {
  tinygltf::TinyGLTF reader;
  // Images are not compared.
  reader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                           const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const bool good = path.extension() == ".glb"
                        ? reader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                        : reader.LoadASCIIFromFile(&model, &error, &warning, path.string());
  EXPECT_TRUE(good) << error;
  EXPECT_EQ(error + warning, "");
  return model;
}

class Interoperates : public testing::TestWithParam<Row> {};

TEST_P(Interoperates, WithTinygltf) {
  Scene scene = loadGltf(test::sharedScenes() / GetParam().at("file")).scene;
  test::addRectangleLight(scene, vec3(1, 2, 3), vec2(2.0f, 1.0f), vec3(5.0f));
  const auto movable = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                    [](const Node& n) { return n.mesh != kNone; });
  ASSERT_NE(movable, scene.nodes.end());
  movable->local.translation += vec3(0.25f, 0.5f, -0.125f);
  const Content ours = contentOf(scene);

  const test::TemporaryFolder folder;
  for (const char* name : {"edited.glb", "edited.gltf"}) {
    saveGltf(scene, folder.path() / name);
    const tinygltf::Model model = readByTinygltf(folder.path() / name);
    if (HasFailure()) return;
    const Content theirs = contentOf(model);
    EXPECT_EQ(theirs.triangles, ours.triangles) << name;
    const float size = std::max(1.0f, glm::length(ours.bounds.extent()));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(theirs.bounds.min[c], ours.bounds.min[c], 1e-5f * size) << name;
      EXPECT_NEAR(theirs.bounds.max[c], ours.bounds.max[c], 1e-5f * size) << name;
    }
    EXPECT_EQ(model.materials.size(), scene.materials.size());
    EXPECT_EQ(model.cameras.size(), scene.cameras.size());
    EXPECT_NE(
        std::find(model.extensionsUsed.begin(), model.extensionsUsed.end(), "EXT_lights_area"),
        model.extensionsUsed.end());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Interoperates,
                         testing::ValuesIn(test::readTable(test::sharedScenes() / "scenes.tsv")),
                         [](const auto& scene) {
                           return test::testNameOf(scene.param.at("file"));
                         });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Interoperates);

}  // namespace
}  // namespace lamplighter
