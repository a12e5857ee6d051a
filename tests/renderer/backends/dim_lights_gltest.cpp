// Dim lights beside bright ones, on the gl backend.
#include "renderer/backends/gl/gl_backend.h"
#include "tests/renderer/backends/dim_light_checks.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using DimLightsGl = test::GlTest;

TEST_F(DimLightsGl, ACandleIsKeptBesideTheSun) { test::expectKeepsACandle(makeGlBackend(), 16384); }

TEST_F(DimLightsGl, ACandleOfFewSamplesIsKeptBesideTheSun) {
  test::expectKeepsACandle(makeGlBackend(), 1000);
}

}  // namespace
}  // namespace lamplighter
