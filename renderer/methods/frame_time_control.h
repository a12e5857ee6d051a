// Turns the time that a frame may take into a number of VPLs to refresh, by how long frames took
// that refreshed so many. It is given measured times and reads no clock; replays do without it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

class FrameTimeControl {
 public:
  // A frame was rendered and its stages were timed.
  void measured(const GiStats& stats);

  // How many VPLs may be refreshed in the next frame, which is to take so long; a few in any case.
  // All other work is theirs, so that this sets every budget.
  int vplsWithin(double seconds);

 private:
  double vpls_ = 0.0, seconds_ = 0.0;  // of a frame, means of the last ones; 0: not known
  int allowed_ = 0;                    // in the frame that is measured next
  double wanted_ = 0.0;                // seconds that it is to take
};

}  // namespace lamplighter
