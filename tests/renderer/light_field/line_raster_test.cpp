// Crossings of lines against rays that go on behind each hit.
#include "renderer/light_field/line_raster.h"

#include <gtest/gtest.h>

#include "tests/renderer/light_field/field_room.h"

namespace lamplighter {
namespace {

// All crossings of a line with the surface, by rays.
std::vector<float> crossingsByRays(const test::FieldRoom& room, const LineGrid& grid, int x,
                                   int y) {
  const vec2 at =
      (vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f - grid.shift) * grid.cell;
  constexpr float kBefore = -20.0f;
  Ray ray{at.x * grid.across + at.y * grid.up + kBefore * grid.along, 0.0f, grid.along};
  std::vector<float> out;
  for (Hit hit = room.rays->intersect(ray); hit; hit = room.rays->intersect(ray)) {
    out.push_back(kBefore + hit.t);
    ray.tNear = hit.t + 1e-3f;
  }
  return out;
}

TEST(LineRaster, FindsWhatRaysFind) {
  const test::FieldRoom room(8, 0.1f);
  size_t lines = 0, wrong = 0, found = 0;
  for (const size_t direction : {size_t{3}, size_t{40}, size_t{77}}) {
    const LineGrid grid = gridOf(room.geometry(FieldSight::lines), direction);
    LineRaster raster;
    raster.draw(room.scene, room.surface, grid);
    for (int y = -30; y < 30; ++y) {
      for (int x = -30; x < 30; ++x) {
        const auto crossings = raster.at(x, y);
        const std::vector<float> expected = crossingsByRays(room, grid, x, y);
        ++lines;
        found += crossings.size();
        if (crossings.size() != expected.size()) {  // at an edge, by rounding
          ++wrong;
          continue;
        }
        for (size_t k = 0; k < expected.size(); ++k)
          EXPECT_NEAR(crossings[k].depth, expected[k], 1e-3f);
      }
    }
  }
  EXPECT_GT(found, lines);
  EXPECT_LT(wrong, lines / 500);
}

// Closed meshes are entered as often as they are left: no line passes between two triangles.
TEST(LineRaster, LinesMeetClosedMeshesAnEvenNumberOfTimes) {
  const test::FieldRoom room(8, 0.05f);
  const LineGrid grid = gridOf(room.geometry(FieldSight::lines), 20);
  LineRaster raster;
  raster.draw(room.scene, room.surface, grid);
  size_t lines = 0;
  for (int y = -100; y < 100; ++y) {
    for (int x = -100; x < 100; ++x) {
      const auto crossings = raster.at(x, y);
      EXPECT_EQ(crossings.size() % 2, 0u);
      lines += crossings.empty() ? 0 : 1;
      int along = 0;
      for (const LineCrossing& c : crossings)
        along += raster.triangle(c.triangle).facesAlong ? 1 : -1;
      EXPECT_EQ(along, 0);
    }
  }
  EXPECT_GT(lines, 5000u);
}

// What is far away changes no line.
TEST(LineRaster, GridsDoNotDependOnTheScene) {
  const test::FieldRoom room;
  test::FieldRoom other;
  other.scene.bounds.add(vec3(1000.0f));
  const LineGrid a = gridOf(room.geometry(FieldSight::lines), 7);
  const LineGrid b = gridOf(other.geometry(FieldSight::lines), 7);
  EXPECT_EQ(a.shift, b.shift);
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.toGrid(vec3(1.0f, 2.0f, 3.0f)), b.toGrid(vec3(1.0f, 2.0f, 3.0f)));
}

}  // namespace
}  // namespace lamplighter
