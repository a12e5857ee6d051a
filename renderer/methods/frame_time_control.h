// Converts a frame time limit to amounts of work, from the measured times of earlier frames. It
// receives times and reads no clock. Replays do not use it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// How long one kind of work takes: running means of frames.
class WorkRate {
 public:
  // `isWhole`: of work that is counted in whole numbers. `mostGrowth`: from a frame to the next.
  explicit WorkRate(bool isWhole = false, double mostGrowth = 2.0)
      : isWhole_(isWhole), mostGrowth_(mostGrowth) {}
  // A frame did this amount in that time [s], within a total of `all` seconds for the whole frame.
  void measured(double amount, double seconds, double all);
  // How much the next frame may do to take at most `seconds` for it, and `all` in total; at least
  // and at most so much; `first` if nothing was measured.
  double within(double seconds, double all, double least, double most, double first);

 private:
  bool isWhole_;
  double mostGrowth_;
  double amount_ = 0.0, seconds_ = 0.0;
  double allowed_ = 0.0, wanted_ = 0.0;  // of the frame that is measured next; total [s]
};

// A frame consists of updates of light samples, of light on surfaces, and of stages that cannot be
// told to do less. If these leave too little, both kinds of work get a quarter of the limit each.
// Paths that repair a picture before it has settled get seven tenths of the time, in frames of
// their own: however long the frames of the method take at least, these keep the limit.
class FrameTimeControl {
 public:
  struct Work {
    int updates = 0;         // the parameter of this name; all other budgets follow it
    int refineUpdates = 0;   // FrameBudget::refineUpdates
    int previewUpdates = 0;  // FrameBudget::previewUpdates
    int previewFrames = 0;   // FrameBudget::previewFrames
    float surfaces = 1.0f;   // FrameBudget::surfaceWork
  };

  // Call after a frame was rendered with measured stages.
  void measured(const GiStats& stats);
  // What the next frame may do to take at most `seconds`; at least a little.
  Work within(double seconds);

 private:
  WorkRate updates_{true}, surfaces_, refinement_{true}, preview_{true, 4.0};
  // Of a frame with updates or light on surfaces, running means [s].
  double ofUpdates_ = 0.0, ofSurfaces_ = 0.0, rest_ = 0.0;
};

}  // namespace lamplighter
