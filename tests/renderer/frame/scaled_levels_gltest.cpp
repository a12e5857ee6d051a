// A level in another unit of length has the picture of the same level in metres, on the gl backend.
#include "renderer/backends/gl/gl_backend.h"
#include "tests/renderer/frame/scaled_levels.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

class ScaledLevelsGl : public test::GlTest {};

TEST_F(ScaledLevelsGl, LookAsInMetresWithEachTechnique) {
  for (const char* technique : {"naive", "light_maps"}) {
    SCOPED_TRACE(technique);
    const Settings settings = test::settingsOfTechnique(technique);
    const Image metres = test::pictureOfRoom(makeGlBackend(), 1.0f, "many_lights", settings);
    for (const float factor : {0x1p-10f, 0x1p10f}) {
      const Image other = test::pictureOfRoom(makeGlBackend(), factor, "many_lights", settings);
      EXPECT_LT(compareImages(metres, other).relRmse, 1e-6) << factor;
    }
  }
}

}  // namespace
}  // namespace lamplighter
