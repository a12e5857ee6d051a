// Converts a frame time limit to a number of updates, from the measured times of earlier
// frames. It receives times and reads no clock. Replays do not use it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

class FrameTimeControl {
 public:
  // Call after a frame was rendered with measured stages.
  void measured(const GiStats& stats);

  // How many updates the next frame may make to take at most `seconds`; at least a few. All other
  // work is proportional to them, so this number sets every budget.
  int updatesWithin(double seconds);

 private:
  double updates_ = 0.0, seconds_ = 0.0;  // of a frame, running means; 0: unknown
  int allowed_ = 0;                       // in the frame that is measured next
  double wanted_ = 0.0;                   // time limit of that frame [s]
};

}  // namespace lamplighter
