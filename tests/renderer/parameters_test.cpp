#include "renderer/parameters.h"

#include <gtest/gtest.h>

#include "renderer/error.h"
#include "renderer/methods/common_parameters.h"

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

}  // namespace
}  // namespace lamplighter
