#include "renderer/methods/stage_timer.h"

#include <algorithm>
#include <stdexcept>

namespace lamplighter {

StageTimer::StageTimer(const FrameInputs& in, std::span<const StageSpec> stages, GiStats& stats)
    : in_(in), stats_(stats) {
  if (!in_.stopwatch) return;
  for (const StageSpec& stage : stages) stats_.stageSeconds.push_back({stage});
  last_ = in_.stopwatch();
}

void StageTimer::end(const StageSpec& stage) {
  if (!in_.stopwatch) return;
  const auto it = std::ranges::find(stats_.stageSeconds, stage, &StageTime::stage);
  if (it == stats_.stageSeconds.end())
    throw std::out_of_range("the method does not declare the stage " + std::string(stage.name));
  in_.backend.finish();
  const double now = in_.stopwatch();
  it->seconds += now - last_;
  last_ = now;
}

}  // namespace lamplighter
