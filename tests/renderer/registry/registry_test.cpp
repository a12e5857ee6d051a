// The declared needs and views of methods against what they use and draw.
#include "renderer/registry/registry.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/debug_views/debug_view.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene floorUnderALamp() {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  test::addRectangleLight(scene, vec3(0, 2, 0), vec2(1.0f), vec3(5.0f));
  return scene;
}

TEST(Registry, MethodsUseOnlyDeclaredServicesAndDrawTheirViews) {
  const Scene scene = floorUnderALamp();
  const View view = test::lookAt(vec3(0, 2, 4), vec3(0), 32, 24);
  for (const MethodInfo& method : methods()) {
    SCOPED_TRACE(method.name);
    FrameRenderer renderer(makeCpuBackend());
    if (!problemOf(method, renderer.backend()).empty()) continue;
    const Settings settings;
    renderer.render({scene, SceneChanges::all(), view, method.name, settings});
    for (const Service service : kServices) {
      if (renderer.services().hasAsked(service)) {
        EXPECT_EQ(std::ranges::count(method.needs.services, service), 1) << nameOf(service);
      }
    }
    const Inspection inspection = renderer.inspect();
    EXPECT_EQ(inspection.pictures.size(), method.views.size());
    for (const MethodView& own : method.views) {
      ASSERT_TRUE(inspection.pictures.contains(own.name));
      const ViewPicture picture = inspection.pictures.at(own.name)();
      EXPECT_EQ(picture.image.width, 32);
      EXPECT_EQ(picture.problem, "");
    }
    const auto isDeclared = [&](Capability capability) {
      return std::ranges::find(method.shows, capability, &ShownCapability::capability) !=
             method.shows.end();
    };
    for (const Capability c :
         {Capability::lights, Capability::patches, Capability::texels, Capability::elements,
          Capability::transfer, Capability::points, Capability::links}) {
      if (inspection.has(c)) {
        EXPECT_TRUE(isDeclared(c)) << nameOf(c);
      }
    }
  }
}

TEST(Registry, MethodsMeasureTheStagesThatTheyDeclare) {
  const Scene scene = floorUnderALamp();
  const View view = test::lookAt(vec3(0, 2, 4), vec3(0), 32, 24);
  Settings settings;
  settings.set("vpls", 8);
  settings.set("refine", 64);
  for (const MethodInfo& method : methods()) {
    SCOPED_TRACE(method.name);
    FrameRenderer renderer(makeCpuBackend(), [t = 0.0]() mutable { return t += 0.001; });
    if (!problemOf(method, renderer.backend()).empty()) continue;
    settings.reset("share_memory");
    settings.reset("indirect");
    settings.set("repair", 0);
    std::vector<StageTime> measured;
    SceneChanges changes = SceneChanges::all();
    for (int i = 0; i < 80; ++i) {
      // Without light shares a picture is antialiased as a whole.
      if (i == 30) settings.set("repair", 64);
      if (i == 40) settings.set("share_memory", 0);
      if (i == 70) settings.set("indirect", std::string("meshes"));
      const GiStats stats =
          renderer
              .render({scene, changes, view, method.name, settings, false, {.refineUpdates = 8}})
              .stats;
      ASSERT_TRUE(std::ranges::equal(stats.stageSeconds, method.stages, {}, &StageTime::stage));
      measured.insert(measured.end(), stats.stageSeconds.begin(), stats.stageSeconds.end());
      changes = {};
    }
    for (const StageSpec& stage : method.stages)
      EXPECT_TRUE(std::ranges::any_of(measured, [&](const StageTime& time) {
        return time.stage == stage && time.seconds > 0.0;
      })) << stage.name;
  }
}

TEST(Registry, WithoutAStopwatchNoStageIsMeasured) {
  const Scene scene = floorUnderALamp();
  const View view = test::lookAt(vec3(0, 2, 4), vec3(0), 32, 24);
  const Settings settings;
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput out =
      renderer.render({scene, SceneChanges::all(), view, "ambient_occlusion", settings});
  EXPECT_TRUE(out.stats.stageSeconds.empty());
  EXPECT_EQ(out.stats.secondsOf(findMethod("ambient_occlusion").stages.front()), 0.0);
}

TEST(Registry, ViewNamesAreUnique) {
  std::set<std::string> names;
  std::set<DebugView> ids;
  for (const DebugViewInfo& view : debugViews()) {
    EXPECT_TRUE(names.insert(view.name).second) << view.name;
    EXPECT_TRUE(ids.insert(view.view).second) << view.name;
  }
}

struct NoKernels : MethodKernels {};

TEST(Registry, AMethodThatCannotRunIsRejectedWithOneLine) {
  const auto backend = makeCpuBackend();
  MethodInfo method = findMethod("reference");
  method.name = "needy";
  EXPECT_EQ(problemOf(method, *backend), "");
  method.needs.openGl = true;
  EXPECT_NE(problemOf(method, *backend).find("needs OpenGL"), std::string::npos);
  method.needs = {{}, {kernelNeed<NoKernels>("needy kernels")}};
  EXPECT_EQ(problemOf(method, *backend),
            "needy needs the kernels needy kernels, which the backend cpu does not have");
}

// Adds a method as a library does that the renderer does not link.
TEST(Registry, AddedMethodsAreListedAndRejectedIfTheyCannotRun) {
  MethodInfo method = findMethod("reference");
  method.name = "added_by_a_test";
  method.needs.openGl = true;
  addMethod(method);
  EXPECT_EQ(findMethod("added_by_a_test").label, method.label);
  EXPECT_THROW(addMethod(method), std::logic_error);
  FrameRenderer renderer(makeCpuBackend());
  const Scene scene = floorUnderALamp();
  const View view = test::lookAt(vec3(0, 2, 4), vec3(0), 32, 24);
  const Settings settings;
  EXPECT_THROW(renderer.render({scene, SceneChanges::all(), view, "added_by_a_test", settings}),
               InputError);
}

}  // namespace
}  // namespace lamplighter
