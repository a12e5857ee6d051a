// Dim lights beside bright ones, on the gl backend.
#include "renderer/backends/gl/gl_backend.h"
#include "tests/renderer/backends/dim_light_checks.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using DimLightsGl = test::GlTest;

TEST_F(DimLightsGl, ACandleIsKeptBesideTheSun) { test::expectKeepsACandle(makeGlBackend()); }

}  // namespace
}  // namespace lamplighter
