// Convergence after an edit, with a clock that only the test advances.
#include "editor/convergence/convergence_meter.h"

#include <cmath>

#include "renderer/base/error.h"
#include "tests/editor/session_fixture.h"

namespace lamplighter {
namespace {

using Sample = Convergence::Sample;

TEST(Convergence, IsBelowALimitOnceItStaysBelow) {
  Convergence c;
  EXPECT_EQ(c.secondsToStayBelow(1.0), std::nullopt);
  c.curve = {{1, 0.5}, {2, 0.04}, {3, 0.12}, {4, 0.09}, {5, 0.06}};
  EXPECT_EQ(c.secondsToStayBelow(0.1), 4.0);
  EXPECT_EQ(c.secondsToStayBelow(0.05), std::nullopt);
  EXPECT_EQ(c.secondsToStayBelow(0.6), 1.0);
  EXPECT_EQ(c.secondsToStayBelow(0.06), std::nullopt) << "the limit itself is not below";
  c.curve.push_back({6, std::nan("")});
  EXPECT_EQ(c.secondsToStayBelow(0.6), std::nullopt);
}

TEST(Convergence, AThinnedCurveKeepsBothEnds) {
  Convergence c;
  EXPECT_TRUE(c.thinnedCurve(2.0).empty());
  for (int i = 1; i <= 13; ++i) c.curve.push_back({static_cast<double>(i), 1.0 / i});
  std::vector<double> seconds;
  for (const Sample& s : c.thinnedCurve(2.0)) seconds.push_back(s.seconds);
  EXPECT_EQ(seconds, (std::vector<double>{1, 2, 4, 8, 13}));
}

class ConvergenceMeterTest : public test::SessionFixture {
 protected:
  // Each look at the clock takes a second.
  double clock_ = 0.0;
  Stopwatch stopwatch_ = [this] { return clock_ += 1.0; };
  ConvergenceMeter meter_{session_, stopwatch_};

  void moveLight() {
    Transform there = local(light_);
    there.translation.x += 1.0f;
    session_.setNodeTransform(light_, there);
  }
  // At most `updates` light samples change in a frame.
  void limitUpdates(int updates, int refine = 0) {
    RenderSettings render = session_.document().render;
    render.values.set("updates", updates);
    render.values.set("frame_time", 0.0f);
    render.values.set("refine", refine);
    render.values.set("repair", 0);
    session_.editing().setInitialRender(render);
    do {
      session_.renderFrame();
    } while (!session_.output().settled);
  }
};

TEST_F(ConvergenceMeterTest, MeasuresFromTheEditToTheSettledPictureWithoutComparisons) {
  limitUpdates(4);
  double error = 1.0;
  const Convergence c = meter_.measure(
      [&] {
        clock_ += 10.0;
        moveLight();
      },
      [&](const Image& picture) {
        EXPECT_EQ(picture.width, 320);
        clock_ += 1000.0;
        return error *= 0.5;
      });
  EXPECT_TRUE(session_.output().settled);
  ASSERT_GT(c.frames, 2);
  ASSERT_EQ(c.curve.size(), static_cast<size_t>(c.frames));
  EXPECT_EQ(c.firstFrame, 11.0);
  for (size_t i = 0; i < c.curve.size(); ++i) {
    EXPECT_EQ(c.curve[i].seconds, 11.0 + static_cast<double>(i));
    EXPECT_EQ(c.curve[i].error, std::pow(0.5, i + 1));
  }
  EXPECT_EQ(c.settled, c.curve.back().seconds);
}

TEST_F(ConvergenceMeterTest, WithoutAComparisonOnlyTheTimesAreMeasured) {
  limitUpdates(4);
  const Convergence c = meter_.measure([&] { moveLight(); }, nullptr);
  EXPECT_TRUE(c.curve.empty());
  EXPECT_EQ(c.firstFrame, 1.0);
  EXPECT_EQ(c.settled, static_cast<double>(c.frames));
}

TEST_F(ConvergenceMeterTest, ATimeLimitEndsAPictureThatIsNotSettled) {
  limitUpdates(1);
  const Convergence c = meter_.measure([&] { moveLight(); }, nullptr, 3.0);
  EXPECT_EQ(c.frames, 3);
  EXPECT_EQ(c.settled, std::nullopt);
}

TEST_F(ConvergenceMeterTest, WithinATimeLimitASettledPictureIsRefined) {
  limitUpdates(100, 512);
  const Convergence settled = meter_.measure([&] { moveLight(); }, nullptr);
  EXPECT_EQ(settled.settled, static_cast<double>(settled.frames));
  const Convergence refined = meter_.measure([&] { moveLight(); }, nullptr, 1e6);
  EXPECT_LT(refined.settled, static_cast<double>(refined.frames));
  EXPECT_TRUE(session_.output().refined);
}

TEST_F(ConvergenceMeterTest, AFrameThatCannotBeRenderedIsAnError) {
  RenderSettings render = session_.document().render;
  render.method = "none";
  EXPECT_THROW(meter_.measure([&] { session_.setRender(render); }, nullptr), InputError);
}

}  // namespace
}  // namespace lamplighter
