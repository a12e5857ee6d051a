#include "renderer/methods/stage_timer.h"

#include <algorithm>
#include <stdexcept>

namespace lamplighter {

StageTimer::StageTimer(const FrameInputs& in, std::span<const StageSpec> stages, GiStats& stats)
    : in_(in), stats_(stats) {
  if (!in_.stopwatch) return;
  for (const StageSpec& stage : stages) stats_.stageSeconds.push_back({stage});
  ownSeconds_.resize(stages.size(), 0.0);
  if (in_.stageTimes == StageTimes::late) in_.backend.beginStages();
  last_ = in_.stopwatch();
}

void StageTimer::end(const StageSpec& stage) {
  if (!in_.stopwatch) return;
  const auto it = std::ranges::find(stats_.stageSeconds, stage, &StageTime::stage);
  if (it == stats_.stageSeconds.end())
    throw std::out_of_range("the method does not declare the stage " + std::string(stage.name));
  const auto index = static_cast<size_t>(it - stats_.stageSeconds.begin());
  const bool isExact = in_.stageTimes == StageTimes::exact;
  if (isExact)
    in_.backend.finish();
  else
    in_.backend.endStage(index);
  const double now = in_.stopwatch();
  double& own = ownSeconds_[index];
  own += now - last_;
  it->seconds = isExact ? own : std::max(own, in_.backend.stageSeconds(index));
  last_ = now;
}

}  // namespace lamplighter
