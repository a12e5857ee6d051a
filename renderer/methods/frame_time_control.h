// Converts a frame time limit to amounts of work, from the measured times of earlier frames. It
// receives times and reads no clock. Replays do not use it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// How long one kind of work takes: running means of frames.
class WorkRate {
 public:
  // A frame did this amount in that time [s], within a total of `all` seconds for the whole frame.
  void measured(double amount, double seconds, double all);
  // How much the next frame may do to take at most `seconds` for it, and `all` in total; at least
  // and at most so much; `first` if nothing was measured.
  double within(double seconds, double all, double least, double most, double first);

 private:
  double amount_ = 0.0, seconds_ = 0.0;
  double allowed_ = 0.0, wanted_ = 0.0;  // of the frame that is measured next; total [s]
};

// A frame consists of updates of light samples, of light on surfaces, and of stages that cannot be
// told to do less. If these leave too little, both kinds of work get a quarter of the limit each.
class FrameTimeControl {
 public:
  struct Work {
    int updates = 0;        // the parameter of this name; all other budgets follow it
    int refineUpdates = 0;  // FrameBudget::refineUpdates
    float surfaces = 1.0f;  // FrameBudget::surfaceWork
  };

  // Call after a frame was rendered with measured stages.
  void measured(const GiStats& stats);
  // What the next frame may do to take at most `seconds`; at least a little.
  Work within(double seconds);

 private:
  WorkRate updates_, surfaces_, refinement_;
  // Of a frame with updates or light on surfaces, running means [s].
  double ofUpdates_ = 0.0, ofSurfaces_ = 0.0, rest_ = 0.0;
};

}  // namespace lamplighter
