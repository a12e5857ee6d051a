#include "renderer/base/parameters.h"

#include <set>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

const ParameterSpec& spec(const char* name) { return manyLightsParameters()[name]; }

TEST(Parameters, TextReadsBackAsItself) {
  for (const float f : {0.0f, 0.1f, 1.0f / 3.0f, 1.0f})
    EXPECT_EQ(std::get<float>(Settings::parse(spec("direct_share"), Settings::format(f))), f);
  EXPECT_EQ(std::get<int>(Settings::parse(spec("vpls"), "1024")), 1024);
}

TEST(Parameters, ValuesOutOfRangeAreRejected) {
  for (const char* text : {"1.5", "nan", ""})
    EXPECT_THROW(Settings::parse(spec("direct_share"), text), InputError) << text;
  for (const char* text : {"0", "12.5", "99999999999999999999", "30x"})
    EXPECT_THROW(Settings::parse(spec("vpls"), text), InputError) << text;
  EXPECT_THROW(Settings::parse(spec("technique"), "fast"), InputError);
}

TEST(Parameters, UnsetOnesHaveTheirDefault) {
  Settings s;
  EXPECT_EQ(s.integer(spec("bounces")), 2);
  s.set("bounces", 5);
  EXPECT_EQ(s.integer(spec("bounces")), 5);
  s.reset("bounces");
  EXPECT_EQ(s.integer(spec("bounces")), 2);
}

// Panels show the parameters of the listed groups only; a parameter in another group would be
// missing.
TEST(Parameters, EveryParameterIsInAGroupThatPanelsShow) {
  for (const MethodInfo& method : methods()) {
    std::set<std::string> shown;
    for (const ParameterGroup group : kParameterGroups) {
      for (const ParameterSpec& spec : method.parameters) {
        const bool isNew = spec.group != group || shown.insert(spec.name).second;
        EXPECT_TRUE(isNew) << spec.name;
      }
    }
    EXPECT_EQ(shown.size(), method.parameters.size()) << method.name;
  }
  EXPECT_EQ(spec("updates").group, ParameterGroup::budgets);
  EXPECT_EQ(spec("vpls").group, ParameterGroup::lightSamples);
}

}  // namespace
}  // namespace lamplighter
