// Measures the stages of a frame.
#pragma once

#include <span>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// Writes the times into the statistics of the frame, measured with the caller's stopwatch. Does
// nothing without a stopwatch. Keeps references to its arguments.
class StageTimer {
 public:
  // Starts the first stage. `stages`: all stages of the method, as in MethodInfo.
  StageTimer(const FrameInputs& in, std::span<const StageSpec> stages, GiStats& stats);

  // Adds the time since the last call to this stage and starts the next stage. Throws
  // std::out_of_range if the method does not declare the stage.
  void end(const StageSpec& stage);

 private:
  const FrameInputs& in_;
  GiStats& stats_;
  double last_ = 0.0;               // [s]
  std::vector<double> ownSeconds_;  // by stage: time of the processor
};

}  // namespace lamplighter
