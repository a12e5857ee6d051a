// The faster backend is chosen, measured by the clock that is passed in.
#include <chrono>

#include "renderer/backends/gl/choose_backend.h"
#include "renderer/backends/many_lights_kernels.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using ChooseBackend = test::GlTest;

TEST_F(ChooseBackend, TakesTheFasterOne) {
  // The cpu backend is tried first: two frames, each with two clock readings. Then gl.
  for (const bool glIsFast : {true, false}) {
    int readings = 0;
    double now = 0.0;
    const Stopwatch clock = [&] {
      const bool ofCpu = readings++ < 4;
      return now += ofCpu == glIsFast ? 2.0 : 1.0;
    };
    BackendTrial trial;
    const auto chosen = chooseBackend(clock, &trial);
    EXPECT_EQ(readings, 8);
    EXPECT_EQ(trial.cpuSeconds, glIsFast ? 2.0 : 1.0);
    EXPECT_EQ(trial.glSeconds, glIsFast ? 1.0 : 2.0);
    EXPECT_EQ(chosen->info().name, glIsFast ? "gl" : "cpu");
    EXPECT_EQ(chosen->kernelsInUse<ManyLightsKernels>(), nullptr);
  }
}

TEST_F(ChooseBackend, WorksWithARealClock) {
  const auto start = std::chrono::steady_clock::now();
  const Stopwatch clock = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  BackendTrial trial;
  chooseBackend(clock, &trial);
  RecordProperty("cpuMilliseconds", std::to_string(1e3 * trial.cpuSeconds));
  RecordProperty("glMilliseconds", std::to_string(1e3 * trial.glSeconds));
  RecordProperty("wholeMilliseconds", std::to_string(1e3 * clock()));
  EXPECT_GT(trial.cpuSeconds, 0.0);
  EXPECT_GT(trial.glSeconds, 0.0);
  EXPECT_LT(clock(), 10.0);
}

}  // namespace
}  // namespace lamplighter
