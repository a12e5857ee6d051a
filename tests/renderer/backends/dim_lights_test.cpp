// Dim lights beside bright ones, on the cpu backend.
#include "tests/renderer/backends/dim_light_checks.h"

namespace lamplighter {
namespace {

TEST(DimLights, ACandleIsKeptBesideTheSun) { test::expectKeepsACandle(makeCpuBackend(), 16384); }

TEST(DimLights, ACandleOfFewSamplesIsKeptBesideTheSun) {
  test::expectKeepsACandle(makeCpuBackend(), 1000);
}

// This number of lights is summed in two parts. Both are kept between frames.
TEST(DimLights, ChangesOfManyLightsLeaveTheBitsOfAFreshSum) {
  const View view = test::viewOfFloor();
  test::LitScene lit(test::darkRoomBelowAPlain());
  std::vector<shared::Vpl> vpls = test::candle(1000);
  for (const shared::Vpl& vpl : test::sunOnThePlain(200)) vpls.push_back(vpl);
  const Image first = lit.sum(vpls, view, 8, true, test::kClampDistance);
  std::vector<shared::Vpl> changed = vpls;
  for (size_t i = 0; i < changed.size(); i += 60) changed[i].intensity *= 1.7f;
  for (size_t i = 7; i < changed.size(); i += 90) changed[i].position.x *= 0.5f;
  const Image second = lit.sum(changed, view, 8, true, test::kClampDistance);
  EXPECT_FALSE(test::sameBits(first, second));
  test::LitScene fresh(test::darkRoomBelowAPlain());
  EXPECT_TRUE(test::sameBits(second, fresh.sum(changed, view, 8, true, test::kClampDistance)));
  // Few lights are summed in one part.
  changed.resize(1000);
  test::LitScene few(test::darkRoomBelowAPlain());
  EXPECT_TRUE(test::sameBits(lit.sum(changed, view, 8, true, test::kClampDistance),
                             few.sum(changed, view, 8, true, test::kClampDistance)));
  EXPECT_TRUE(test::sameBits(first, lit.sum(vpls, view, 8, true, test::kClampDistance)));
}

}  // namespace
}  // namespace lamplighter
