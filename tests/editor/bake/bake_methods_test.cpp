// The conversion of parameters of methods to options of baking.
#include "editor/bake/bake_methods.h"

#include <gtest/gtest.h>

#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

TEST(BakeMethods, TakeTheBouncesAndTheSeedOfTheirMethods) {
  for (const BakeMethodInfo& method : bakeMethods()) {
    EXPECT_NO_THROW(findMethod(method.name)) << method.name;
    Settings settings;
    settings.set("bounces", 3);
    settings.set("seed", 7);
    const BakeLightOptions light = bakeLightOptions(method.name, settings);
    EXPECT_EQ(light.paths.bounces, 3) << method.name;
    EXPECT_EQ(light.paths.seed, 7u) << method.name;
  }
  EXPECT_EQ(bakeLightOptions("reference", {}).method, BakeMethod::reference);
  EXPECT_EQ(bakeLightOptions("multi_mesh", {}).method, BakeMethod::meshes);
  EXPECT_EQ(bakeLightOptions("surface_shadow_maps", {}).method, BakeMethod::links);
}

TEST(BakeMethods, DefaultsForBakingGiveWayToWhatIsSet) {
  const auto texelOf = [](const Settings& settings) {
    return bakeLightOptions("surface_shadow_maps", settings).texels.texel;
  };
  Settings settings;
  EXPECT_FLOAT_EQ(texelOf(settings), 0.1f);
  settings.set("texel", 0.5f);
  EXPECT_FLOAT_EQ(texelOf(settings), 0.5f);
}

}  // namespace
}  // namespace lamplighter
