#include "renderer/texels/texel_neighbours.h"

#include <gtest/gtest.h>

#include "tests/renderer/surface_depths/lit_texels.h"

namespace lamplighter {
namespace {

// A floor of texels of 0.25 m, and a wall of 4 cm on it between two rows of them.
struct WallOnFloor {
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  ObjectCharts charts{std::filesystem::path()};
  TexelSet texels;
  TexelNeighbours neighbours;

  explicit WallOnFloor(bool hasWall) {
    Scene s;
    const int white = test::addMaterial(s, vec3(0.7f));
    test::addMesh(s, test::squareMesh(4.0f, white));
    if (hasWall)
      test::addMesh(s, test::boxMesh(vec3(4.0f, 1.0f, 0.04f), white), vec3(0.0f, 0.5f, 0.0f));
    scene = test::renderSceneOf(s);
    rays = std::make_unique<RayCaster>(scene);
    texels = TexelSet(scene, charts.find(scene, 4.0f), TexelOrder::zigzag);
    texels.findBuried(scene, *rays);
    neighbours.find(scene, *rays, texels);
  }
  // Halves of the texels of the floor that are nearest to two points.
  TexelBlend between(const vec3& a, const vec3& b) const {
    TexelBlend blend;
    for (const vec3& p : {a, b}) {
      float nearest = 1e9f;
      const size_t k = p == a ? 0 : 1;
      for (uint32_t t = 0; t < texels.size(); ++t) {
        const float distance = glm::distance(texels[t].spot.position, p);
        if (texels[t].object != 0 || distance >= nearest) continue;
        nearest = distance;
        blend.texels[k] = t;
        blend.weights[k] = 0.5f;
      }
    }
    return blend;
  }
};

TEST(TexelNeighbours, PixelsLeaveOutTexelsBehindAThinWall) {
  const WallOnFloor floor(true);
  TexelBlend blend = floor.between(vec3(0.6f, 0.0f, -0.13f), vec3(0.6f, 0.0f, 0.13f));
  ASSERT_NE(blend.texels[0], blend.texels[1]);
  floor.neighbours.keepVisible(floor.scene, *floor.rays, floor.texels, vec3(0.6f, 0.0f, -0.03f),
                               blend);
  EXPECT_EQ(blend.weights[0], 1.0f);
  EXPECT_EQ(blend.weights[1], 0.0f);
}

TEST(TexelNeighbours, PixelsKeepTexelsThatTheySee) {
  for (const bool hasWall : {false, true}) {
    const WallOnFloor floor(hasWall);
    const float z = hasWall ? -1.0f : 0.0f;
    TexelBlend blend = floor.between(vec3(0.6f, 0.0f, z - 0.13f), vec3(0.6f, 0.0f, z + 0.13f));
    floor.neighbours.keepVisible(floor.scene, *floor.rays, floor.texels,
                                 vec3(0.6f, 0.0f, z - 0.03f), blend);
    EXPECT_EQ(blend.weights[0], 0.5f);
    EXPECT_EQ(blend.weights[1], 0.5f);
  }
}

}  // namespace
}  // namespace lamplighter
