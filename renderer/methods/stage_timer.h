// Measures the stages of a frame.
#pragma once

#include <span>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// Writes the times into the statistics of the frame, by the caller's stopwatch. Does nothing if
// there is none. Holds references to its arguments.
class StageTimer {
 public:
  // The first stage begins now. `stages`: all of the method, as in MethodInfo.
  StageTimer(const FrameInputs& in, std::span<const StageSpec> stages, GiStats& stats);

  // Adds the time since the last call to this stage; the next stage begins. Throws
  // std::out_of_range if the method does not declare the stage.
  void end(const StageSpec& stage);

 private:
  const FrameInputs& in_;
  GiStats& stats_;
  double last_ = 0.0;               // [s]
  std::vector<double> ownSeconds_;  // by stage: of the processor
};

}  // namespace lamplighter
