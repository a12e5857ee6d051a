#include "renderer/base/parameters.h"

#include <set>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

TEST(Parameters, TextReadsBackAsItself) {
  const ParameterSpec& share = parameters::directShare();
  for (const float f : {0.0f, 0.1f, 1.0f / 3.0f, 1.0f}) {
    EXPECT_EQ(std::get<float>(Settings::parse(share, Settings::format(f))), f);
  }
  EXPECT_EQ(std::get<int>(Settings::parse(parameters::vpls(), "1024")), 1024);
}

TEST(Parameters, WhatIsOutOfRangeIsRefused) {
  EXPECT_THROW(Settings::parse(parameters::directShare(), "1.5"), InputError);
  EXPECT_THROW(Settings::parse(parameters::directShare(), "nan"), InputError);
  EXPECT_THROW(Settings::parse(parameters::directShare(), ""), InputError);
  EXPECT_THROW(Settings::parse(parameters::vpls(), "0"), InputError);
  EXPECT_THROW(Settings::parse(parameters::vpls(), "12.5"), InputError);
  EXPECT_THROW(Settings::parse(parameters::vpls(), "99999999999999999999"), InputError);
  EXPECT_THROW(Settings::parse(parameters::vpls(), "30x"), InputError);
}

TEST(Parameters, UnsetOnesHaveTheirDefault) {
  Settings s;
  EXPECT_EQ(s.integer(parameters::bounces()), 2);
  s.set("bounces", 5);
  EXPECT_EQ(s.integer(parameters::bounces()), 5);
  s.reset("bounces");
  EXPECT_EQ(s.integer(parameters::bounces()), 2);
}

// Panels show group by group: one that is not listed would not be seen at all.
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
  EXPECT_EQ(parameters::updates().group, ParameterGroup::budgets);
  EXPECT_EQ(parameters::vpls().group, ParameterGroup::lightSamples);
}

}  // namespace
}  // namespace lamplighter
