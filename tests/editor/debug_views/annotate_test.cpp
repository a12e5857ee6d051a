// Shapes, text and legends that are drawn into pictures, and the positions of light sample marks.
#include "editor/debug_views/annotate.h"

#include <gtest/gtest.h>

#include "editor/debug_views/legend.h"
#include "editor/debug_views/look.h"
#include "editor/debug_views/vpl_overlay.h"
#include "renderer/base/error.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

int brightness(const Image8& image, int x, int y) {
  const uint8_t* p = image.at(x, y);
  return p[0] + p[1] + p[2];
}

Image8 black(int width, int height) {
  Image8 image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), uint8_t{0});
  return image;
}

TEST(Annotate, AFilledShapeCoversItsAreaInBothOrientations) {
  for (const bool clockwise : {true, false}) {
    Image8 image = black(40, 30);
    OverlayShape shape{{{5.25f, 4.0f}, {25.25f, 4.0f}, {25.25f, 14.0f}, {5.25f, 14.0f}},
                       true,
                       true,
                       vec4(1.0f, 1.0f, 1.0f, 1.0f)};
    if (!clockwise) std::reverse(shape.points.begin(), shape.points.end());
    drawOverlay(image, {{shape}, {}}, nullptr);
    double sum = 0.0;
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x) sum += brightness(image, x, y) / 765.0;
    EXPECT_NEAR(sum, 200.0, 0.5);
    EXPECT_EQ(brightness(image, 15, 9), 765);
    EXPECT_EQ(brightness(image, 15, 15), 0);
    EXPECT_NEAR(brightness(image, 5, 9), 0.75 * 765, 4);  // a quarter of that pixel is outside
  }
}

TEST(Annotate, LinesAreBlendedOnceAndClippedAtTheEdges) {
  Image8 image = black(40, 30);
  OverlayShape line{{{-1e7f, 10.0f}, {20.0f, 10.0f}, {20.0f, 1e7f}}, false, false, vec4(0.5f)};
  line.thickness = 4.0f;
  drawOverlay(image, {{line}, {}}, nullptr);
  EXPECT_NEAR(brightness(image, 3, 10), 765 / 4, 4);
  EXPECT_EQ(brightness(image, 20, 10), brightness(image, 3, 10));  // where both lines cross
  EXPECT_EQ(brightness(image, 30, 10), 0);
}

TEST(Annotate, AMissingFontIsAnError) {
  try {
    const Font font("/nowhere/none.otf", 15, "--legend");
    FAIL();
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_TRUE(what.starts_with("--legend: text cannot be drawn: ")) << what;
    EXPECT_NE(what.find("/nowhere/none.otf"), std::string::npos) << what;
    EXPECT_NE(what.find("install fonts-inter"), std::string::npos) << what;
  }
}

TEST(Annotate, ALegendFitsTheAvailableWidth) {
  ViewPicture picture;
  picture.legend.title = "Title";
  picture.legend.swatches = {{vec3(1, 0, 0), "red"}, {vec3(0, 1, 0), "green"}};
  const LegendStyle style{
      1.0f, 16.0f, [](const std::string& text) { return 8.0f * static_cast<float>(text.size()); }};
  const LegendLayout column = layOutLegend(picture, style, 0.0f);
  const LegendLayout row = layOutLegend(picture, style, 1000.0f);
  EXPECT_NEAR(column.size.y, 3 * 20.0f - 4.0f, 1e-3f);
  EXPECT_NEAR(row.size.y, 16.0f, 1e-3f);
  EXPECT_GT(row.size.x, 2.0f * column.size.x);
  ASSERT_EQ(row.overlay.texts.size(), 3u);
  for (size_t i = 0; i + 1 < 3; ++i)
    EXPECT_LT(row.overlay.texts[i].position.x, row.overlay.texts[i + 1].position.x);
  // The width that it used is sufficient.
  EXPECT_NEAR(layOutLegend(picture, style, row.size.x).size.y, 16.0f, 1e-3f);
  EXPECT_GT(layOutLegend(picture, style, row.size.x - 1.0f).size.y, 30.0f);
  picture.problem = "it cannot";
  EXPECT_EQ(layOutLegend(picture, style, 0.0f).overlay.texts[0].text, "Not shown: it cannot");
  EXPECT_EQ(layOutLegend({}, style, 0.0f).size, vec2(0.0f));
}

TEST(Annotate, MarksOfParallelLightLieOnTheLitSurface) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(10.0f, test::addMaterial(scene, vec3(0.5f))));
  const test::LitScene lit(scene);
  View view;
  view.width = view.height = 200;
  view.eye = vec3(0, 3, 8);
  view.orientation = glm::angleAxis(-0.3f, vec3(1, 0, 0));
  LightSample sun;
  sun.isLive = true;
  // The centre of its square is below the floor.
  sun.vpl = test::makeVpl(vec3(1, -2, 0), vec3(0, 1, 0), shared::kVplDirectional);
  sun.vpl.normal.w = 20.0f;
  Inspection inspection;
  inspection.lights = {&sun, 1};
  const vec2 landed(view.project(vec3(1, 0, 0)));
  EXPECT_EQ(pickVpl(view, inspection, *lit.rays, landed), 0);
  EXPECT_EQ(pickVpl(view, inspection, *lit.rays, vec2(view.project(vec3(1, -2, 0)))), kNone);
  Overlay overlay;
  drawVpls(overlay, view, inspection, *lit.rays, kNone);
  const auto mark = std::find_if(overlay.shapes.begin(), overlay.shapes.end(),
                                 [](const OverlayShape& s) { return s.filled; });
  ASSERT_NE(mark, overlay.shapes.end());
  ASSERT_EQ(mark->points.size(), 4u);
  EXPECT_NEAR(mark->points[0].y, mark->points[3].y, 1e-3f);  // a square, not a diamond
  EXPECT_EQ(mark->colour.a, 1.0f);                           // not faded, since nothing occludes it
}

TEST(Annotate, PointsOfAMethodAreMarked) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(10.0f, test::addMaterial(scene, vec3(0.5f))));
  const test::LitScene lit(scene);
  const View view = test::lookAt(vec3(0, 3, 8), vec3(0), 200, 200);
  Inspection inspection;
  inspection.points = [] {
    return std::vector<InspectedPoint>{{vec3(1, 0, 0), vec3(0, 1, 0)}, {vec3(0, -2, 0)}};
  };
  Overlay overlay;
  drawVpls(overlay, view, inspection, *lit.rays, kNone);
  ASSERT_EQ(overlay.shapes.size(), 3u) << "two triangles and a normal";
  EXPECT_EQ(overlay.shapes[0].points.size(), 3u);
  EXPECT_EQ(overlay.shapes[0].colour.a, 1.0f);
  EXPECT_LT(overlay.shapes[2].colour.a, 0.5f) << "below the floor";
}

}  // namespace
}  // namespace lamplighter
