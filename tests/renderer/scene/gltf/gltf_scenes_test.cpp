// Every third-party scene loads with the contents listed in the table.
#include <sstream>

#include <gtest/gtest.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

using Row = std::map<std::string, std::string>;

class SharedScene : public testing::TestWithParam<Row> {};

vec3 parseVec3(const std::string& text) {
  vec3 v(0.0f);
  std::istringstream(text) >> v.x >> v.y >> v.z;
  return v;
}

TEST_P(SharedScene, LoadsAsListed) {
  const Row& row = GetParam();
  const auto number = [&](const char* column) {
    return static_cast<size_t>(std::stoul(row.at(column)));
  };
  const LoadedScene loaded = loadGltf(test::sharedScenes() / row.at("file"));
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.nodes.size(), number("nodes"));
  EXPECT_EQ(scene.meshes.size(), number("meshes"));
  EXPECT_EQ(scene.materials.size(), number("materials"));
  EXPECT_EQ(scene.cameras.size(), number("cameras"));

  size_t draws = 0, triangles = 0, punctuals = 0;
  for (const Node& node : scene.nodes) {
    punctuals += node.punctual ? 1 : 0;
    if (node.mesh == kNone) continue;
    for (const Primitive& p : scene.meshes[static_cast<size_t>(node.mesh)]->primitives) {
      ++draws;
      triangles += p.indices.size() / 3;
    }
  }
  EXPECT_EQ(draws, number("draws"));
  EXPECT_EQ(triangles, number("triangles"));
  EXPECT_EQ(punctuals, number("punctual_lights"));
  size_t emitting = 0;
  for (const Material& m : scene.materials) emitting += m.emits() ? 1 : 0;
  EXPECT_EQ(emitting, number("emissive_materials"));

  for (const Texture& t : scene.textures) EXPECT_FALSE(t.placeholder) << t.name;
  const bool isLit = punctuals > 0 || emitting > 0;
  EXPECT_EQ(scene.skyIsDefault, !isLit);
  ASSERT_EQ(loaded.warnings.size(), isLit ? 0u : 1u) << loaded.warnings.front();

  // The bounds of RenderScene depend on the treatment of transparent panes. These bounds include
  // all geometry.
  const vec3 low = parseVec3(row.at("bounds_min")), high = parseVec3(row.at("bounds_max"));
  const std::vector<mat4> world = worldMatrices(scene);
  Bounds bounds;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh == kNone) continue;
    for (const Primitive& p : scene.meshes[static_cast<size_t>(scene.nodes[i].mesh)]->primitives) {
      for (const vec3& v : p.positions) bounds.add(vec3(world[i] * vec4(v, 1.0f)));
    }
  }
  // The table has three decimal places.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(bounds.min[c], low[c], 0.00051f + 1e-6f * std::abs(low[c]));
    EXPECT_NEAR(bounds.max[c], high[c], 0.00051f + 1e-6f * std::abs(high[c]));
  }
}

TEST_P(SharedScene, HasUsableNormalsEverywhere) {
  const LoadedScene loaded = loadGltf(test::sharedScenes() / GetParam().at("file"));
  for (const auto& mesh : loaded.scene.meshes) {
    for (const Primitive& p : mesh->primitives) {
      ASSERT_EQ(p.normals.size(), p.positions.size());
      for (const vec3& n : p.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << mesh->name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharedScene,
                         testing::ValuesIn(test::readTable(test::sharedScenes() / "scenes.tsv")),
                         [](const auto& scene) {
                           return test::testNameOf(scene.param.at("file"));
                         });
// There are no instances if the scenes are missing.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedScene);

}  // namespace
}  // namespace lamplighter
