// Light in vertex colours: round trip, closed forms, no cracks, same bits.
#include "editor/bake/vertex_colour_job.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/surface.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

class VertexColours : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    options_.output =
        fs::temp_directory_path() / ("lamplighter_colours_" + std::string(info->name()));
    options_.name = "room";
    options_.light.method = BakeMethod::meshes;
    options_.light.surface.mask = 32;
    options_.light.surface.gatherRays = 64;
    options_.vertices.shortestEdge = 0.2f;
    fs::remove_all(options_.output);
    fs::create_directories(options_.output);
  }
  void TearDown() override { fs::remove_all(options_.output); }

  LitScene lit(const Scene& scene) const { return *withVertexColours(scene, options_, {}); }

  VertexColourOptions options_;
};

Scene litRoom() {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.8f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(0.7f, 0.5f, -0.5f));
  test::addRectangleLight(scene, vec3(0, 2.8f, 0), vec2(1), vec3(8));
  return scene;
}

using Place = std::tuple<float, float, float>;
Place placeOf(const vec3& p) { return {p.x, p.y, p.z}; }

double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (const Primitive& p : mesh.primitives)
    for (size_t i = 0; i < p.indices.size(); i += 3) {
      const vec3 a = p.positions[p.indices[i]];
      area += 0.5 * static_cast<double>(glm::length(glm::cross(p.positions[p.indices[i + 1]] - a,
                                                               p.positions[p.indices[i + 2]] - a)));
    }
  return area;
}

// Of a closed mesh: the edges that not exactly two triangles have.
size_t openEdges(const Mesh& mesh) {
  std::map<std::set<Place>, int> uses;
  for (const Primitive& p : mesh.primitives)
    for (size_t i = 0; i < p.indices.size(); i += 3)
      for (size_t e = 0; e < 3; ++e)
        ++uses[{placeOf(p.positions[p.indices[i + e]]),
                placeOf(p.positions[p.indices[i + (e + 1) % 3]])}];
  size_t open = 0;
  for (const auto& [edge, count] : uses) open += count != 2;
  return open;
}

TEST_F(VertexColours, AreWrittenAndComeBackWithTheSameAreaAndWithoutCracks) {
  const Scene scene = litRoom();
  const LitScene made = lit(scene);
  EXPECT_GT(made.triangles, 5 * made.trianglesBefore) << "shadows need divided triangles";
  EXPECT_EQ(writeLitScene(made, options_).back().filename(), "room-light.json");
  const Scene copy = loadGltf(options_.output / "room.gltf").scene;
  ASSERT_EQ(copy.nodes.size(), scene.nodes.size());
  float brightest = 0.0f;
  for (size_t n = 0; n < 2; ++n) {
    const Mesh& before = *scene.meshes[static_cast<size_t>(scene.nodes[n].mesh)];
    const Mesh& after = *copy.meshes[static_cast<size_t>(copy.nodes[n].mesh)];
    EXPECT_NEAR(areaOf(after), areaOf(before), 1e-4 * areaOf(before));
    EXPECT_EQ(openEdges(before), 0u);
    EXPECT_EQ(openEdges(after), 0u);
    for (const Primitive& p : after.primitives) {
      ASSERT_EQ(p.colors.size(), p.positions.size());
      EXPECT_EQ(p.material, before.primitives[0].material);
      for (const vec4& c : p.colors) brightest = std::max({brightest, c.r, c.g, c.b});
    }
  }
  EXPECT_NEAR(brightest, 1.0f, 1e-5f);
}

// Vertices at one place with one normal have one colour, so that no seam is seen.
TEST_F(VertexColours, AreEqualAtTheSamePlaceAndNormal) {
  const LitScene made = lit(litRoom());
  std::map<std::pair<Place, Place>, vec4> colours;
  const Primitive& p = made.scene.meshes[0]->primitives[0];
  for (size_t v = 0; v < p.positions.size(); ++v) {
    const auto [it, isNew] =
        colours.emplace(std::pair(placeOf(p.positions[v]), placeOf(p.normals[v])), p.colors[v]);
    EXPECT_EQ(it->second, p.colors[v]);
  }
}

// A closed room of one albedo ρ that emits L everywhere: E = π L (1 + ρ + … + ρⁿ).
TEST_F(VertexColours, OfAFurnaceAreItsClosedFormAndNeedNoDivision) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(2), test::addMaterial(scene, vec3(0.5f), vec3(1.0f))));
  options_.light.surface.bounces = 3;
  options_.exposure = -2.0f;
  const LitScene made = lit(scene);
  EXPECT_EQ(made.triangles, made.trianglesBefore);
  EXPECT_EQ(made.clipped, 0u);
  for (const vec4& c : made.scene.meshes[0]->primitives[0].colors)
    EXPECT_NEAR(c.g, 1.875f / 4.0f, 0.01f);
  options_.exposure = 0.0f;
  EXPECT_GT(lit(scene).clipped, 0u);
}

TEST_F(VertexColours, HaveTheSameBitsWithOneAndTwoThreads) {
  const Scene scene = litRoom();
  const auto coloursWith = [&](int threads) {
    const ThreadLimit limit(threads);
    return lit(scene);
  };
  const LitScene one = coloursWith(1), two = coloursWith(2);
  ASSERT_EQ(one.scene.meshes.size(), two.scene.meshes.size());
  for (size_t m = 0; m < one.scene.meshes.size(); ++m) {
    const Primitive &a = one.scene.meshes[m]->primitives[0],
                    &b = two.scene.meshes[m]->primitives[0];
    EXPECT_EQ(a.indices, b.indices);
    EXPECT_EQ(a.colors, b.colors);
  }
}

TEST_F(VertexColours, GiveInstancesThatAreLitDifferentlyMeshesOfTheirOwn) {
  Scene scene = litRoom();
  const auto mesh = scene.meshes[1];
  Node again = scene.nodes[1];
  again.id = scene.nextId++;
  again.local.translation = vec3(-1.0f, 0.5f, 1.0f);
  scene.nodes.push_back(again);
  LitScene made = lit(scene);
  EXPECT_NE(made.scene.nodes[1].mesh, made.scene.nodes.back().mesh);
  EXPECT_EQ(made.meshes, 3u);
  // Without light they are alike.
  Scene dark = scene;
  std::erase_if(dark.nodes, [](const Node& n) { return n.area.has_value(); });
  made = lit(dark);
  EXPECT_EQ(made.scene.nodes[1].mesh, made.scene.nodes.back().mesh);
  for (const vec4& c : made.scene.meshes[1]->primitives[0].colors) EXPECT_EQ(c, vec4(0, 0, 0, 1));
}

TEST_F(VertexColours, MultiplyTheColoursBeforeAndKeepAlpha) {
  Scene scene;
  auto mesh =
      std::make_shared<Mesh>(*test::roomMesh(vec3(2), test::addMaterial(scene, vec3(0.0f))));
  mesh->primitives[0].colors.assign(mesh->primitives[0].positions.size(),
                                    vec4(1.0f, 0.5f, 0.0f, 0.25f));
  test::addMesh(scene, mesh);
  test::addRectangleLight(scene, vec3(0, 0.9f, 0), vec2(0.5f), vec3(1));
  const LitScene made = lit(scene);
  for (const vec4& c : made.scene.meshes[0]->primitives[0].colors) {
    EXPECT_NEAR(c.g, 0.5f * c.r, 1e-5f);
    EXPECT_EQ(c.b, 0.0f);
    EXPECT_EQ(c.a, 0.25f);
  }
}

// The scene reverses triangles of mirrored nodes: each vertex must still have the light of its
// place.
TEST_F(VertexColours, OfAMirroredNodeAreBrightestBelowTheLamp) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  scene.nodes[0].local.scale = vec3(-1, 1, 1);
  test::addRectangleLight(scene, vec3(1.5f, 0.5f, 0.75f), vec2(0.2f), vec3(1));
  const LitScene made = lit(scene);
  const Primitive& p = made.scene.meshes[0]->primitives[0];
  const auto brightest = std::ranges::max_element(p.colors, {}, [](const vec4& c) { return c.g; });
  const vec3 at = p.positions[static_cast<size_t>(brightest - p.colors.begin())];
  EXPECT_NEAR(-at.x, 1.5f, 0.3f);
  EXPECT_NEAR(at.z, 0.75f, 0.3f);
  // As many triangles as without the mirror.
  scene.nodes[0].local.scale = vec3(1);
  scene.nodes[1].local.translation.x = -1.5f;
  EXPECT_NEAR(static_cast<double>(lit(scene).triangles), static_cast<double>(made.triangles),
              0.1 * static_cast<double>(made.triangles));
}

TEST_F(VertexColours, KeepUvsNormalsTangentsAndHierarchy) {
  Scene scene = litRoom();
  auto mesh = std::make_shared<Mesh>(*scene.meshes[0]);
  Primitive& before = mesh->primitives[0];
  before.uv0.clear(), before.uv1.clear();
  for (const vec3& p : before.positions) {
    before.uv0.push_back(vec2(p.x + p.y, p.z));
    before.uv1.push_back(vec2(p.y, p.x - p.z));
    before.tangents.push_back(vec4(1, 0, 0, -1));
  }
  scene.meshes[0] = mesh;
  scene.nodes[1].parent = scene.nodes[0].id;
  const LitScene made = lit(scene);
  EXPECT_EQ(made.scene.nodes, scene.nodes);
  EXPECT_EQ(made.scene.materials, scene.materials);
  const Primitive& p = made.scene.meshes[0]->primitives[0];
  ASSERT_GT(p.positions.size(), before.positions.size());
  ASSERT_EQ(p.uv0.size(), p.positions.size());
  ASSERT_EQ(p.uv1.size(), p.positions.size());
  ASSERT_EQ(p.tangents.size(), p.positions.size());
  for (size_t v = 0; v < p.positions.size(); ++v) {
    const vec3& at = p.positions[v];
    EXPECT_NEAR(glm::distance(p.uv0[v], vec2(at.x + at.y, at.z)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::distance(p.uv1[v], vec2(at.y, at.x - at.z)), 0.0f, 1e-5f);
    EXPECT_NEAR(glm::length(p.normals[v]), 1.0f, 1e-5f);
    EXPECT_EQ(p.tangents[v], vec4(1, 0, 0, -1));
  }
}

// A zero-area triangle on an edge is divided with it, and the work ends.
TEST_F(VertexColours, EndWithTrianglesWithoutArea) {
  Scene scene = litRoom();
  auto mesh = std::make_shared<Mesh>(*scene.meshes[0]);
  Primitive& p = mesh->primitives[0];
  const auto first = static_cast<uint32_t>(p.positions.size());
  for (const float x : {-2.0f, -0.4f, 2.0f}) {
    p.positions.push_back(vec3(x, -1.5f, 0.3f));
    p.normals.push_back(vec3(0, 1, 0));
    if (!p.uv0.empty()) p.uv0.push_back(vec2(0.0f));
  }
  p.indices.insert(p.indices.end(), {first, first + 1, first + 2});
  scene.meshes[0] = mesh;
  EXPECT_LT(lit(scene).triangles, 20000u);
}

// Shown as an engine would, base colour × vertex colour / scale.
TEST_F(VertexColours, MatchThePathTracer) {
  Scene scene = litRoom();
  options_.vertices = {0.02f, 0.03f};  // light between vertices is linear
  options_.light.surface.bounces = 2;
  options_.light.surface.gatherRays = 256;
  const LitScene made = lit(scene);
  const RenderScene render = test::renderSceneOf(made.scene);
  const RayCaster rays(render);
  const View view = test::lookAt(vec3(1.6f, 1.7f, 1.8f), vec3(-0.2f, 0.9f, -0.3f), 64, 48, 0.9f);
  const Image reference = test::renderReference(scene, view, 96, 2);
  constexpr int kSide = 4;  // rays along a side of a pixel
  Image shown(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      // As antialiased as the reference.
      for (int i = 0; i < kSide * kSide; ++i) {
        const float dx = (static_cast<float>(i % kSide) + 0.5f) / kSide;
        const float dy = (static_cast<float>(i / kSide) + 0.5f) / kSide;
        const vec3 direction =
            view.rayDirection(static_cast<float>(x) + dx, static_cast<float>(y) + dy);
        const Hit hit = rays.intersect({view.eye, 0.0f, direction}, Surfaces::seen);
        ASSERT_TRUE(hit);
        const Surface s = surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v);
        shown.at(x, y) += (s.albedo / made.scale + s.emission) / static_cast<float>(kSide * kSide);
      }
    }
  }
  const Metrics m = compareImages(shown, reference);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_NEAR(m.bias, 1.0, 0.02);
}

TEST_F(VertexColours, LeaveNothingWhereTheyCannotBeWritten) {
  fs::create_directories(options_.output / "room.gltf" / "in the way");
  const LitScene made = lit(litRoom());
  EXPECT_THROW(writeLitScene(made, options_), InputError);
  size_t files = 0;
  for (const fs::directory_entry& e : fs::directory_iterator(options_.output))
    files += e.is_regular_file();
  EXPECT_EQ(files, 0u);
}

TEST_F(VertexColours, StopWhenTheProgressSaysSo) {
  EXPECT_FALSE(withVertexColours(litRoom(), options_, [](int, int) { return false; }));
  EXPECT_THROW(withVertexColours(Scene(), options_, {}), InputError);
}

}  // namespace
}  // namespace lamplighter
