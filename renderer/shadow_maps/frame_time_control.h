// Turns the time that a frame may take into a number of VPLs to refresh, by what frames cost
// before. It is given measured times and reads no clock; replays do without it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

class FrameTimeControl {
 public:
  // A frame was rendered and its stages were timed.
  void measured(const GiStats& stats);

  // How many VPLs can be refreshed in a frame of so long, and a few in any case. All other work is
  // theirs, so that this sets every budget.
  int vplsWithin(double seconds) const;

 private:
  double perVpl_ = 0.0;  // seconds, mean of the last frames; 0: not known
  double rest_ = 0.0;    // seconds that a frame takes without any
};

}  // namespace lamplighter
