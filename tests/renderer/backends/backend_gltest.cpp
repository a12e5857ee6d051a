// What the gl backend provides to every method.
#include "renderer/backends/gl/gl_backend.h"
#include "tests/renderer/backends/backend_checks.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using GlBackendTest = test::GlTest;

TEST_F(GlBackendTest, ComposesAnyIrradiance) { test::expectComposesAnyIrradiance(makeGlBackend()); }

TEST_F(GlBackendTest, HostGBufferEqualsRayHits) {
  test::expectHostGBufferEqualsRayHits(makeGlBackend());
}

}  // namespace
}  // namespace lamplighter
