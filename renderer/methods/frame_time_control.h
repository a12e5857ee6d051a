// Converts a frame time limit to amounts of work, from the measured times of earlier frames. It
// receives times and reads no clock. Replays do not use it.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// Time that one kind of work takes: running means over frames.
class WorkRate {
 public:
  // `isWhole`: the work is counted in whole numbers. `mostGrowth`: maximum growth factor from one
  // frame to the next.
  explicit WorkRate(bool isWhole = false, double mostGrowth = 2.0)
      : isWhole_(isWhole), mostGrowth_(mostGrowth) {}
  // Records that a frame did this amount of work in this time [s], with `all` seconds for the whole
  // frame.
  void measured(double amount, double seconds, double all);
  // Amount of work for the next frame, so that the work takes at most `seconds` and the frame `all`
  // seconds; clamped to the given limits. Returns `first` if nothing was measured.
  double within(double seconds, double all, double least, double most, double first);

 private:
  bool isWhole_;
  double mostGrowth_;
  double amount_ = 0.0, seconds_ = 0.0;
  double allowed_ = 0.0,
         wanted_ = 0.0;  // allowed and wanted total time of the frame that is measured next [s]
};

// A frame consists of updates of light samples, of light on surfaces, and of stages of fixed cost.
// If these leave too little time, both kinds of updates get a quarter of the limit each. Paths that
// repair a picture before it has settled get seven tenths of the time, in separate frames: these
// keep the limit, however long the frames of the method take.
class FrameTimeControl {
 public:
  struct Work {
    int updates = 0;         // the parameter of this name; all other budgets follow it
    int refineUpdates = 0;   // FrameBudget::refineUpdates
    int previewUpdates = 0;  // FrameBudget::previewUpdates
    int previewFrames = 0;   // FrameBudget::previewFrames
    float surfaces = 1.0f;   // FrameBudget::surfaceWork
  };

  // Call after a frame with measured stages.
  void measured(const GiStats& stats);
  // Budget of the next frame, so that it takes at most `seconds`; never zero.
  Work within(double seconds);

 private:
  WorkRate updates_{true}, surfaces_, refinement_{true}, preview_{true, 4.0};
  // Running means of the times of frames with updates or light on surfaces [s].
  double ofUpdates_ = 0.0, ofSurfaces_ = 0.0, rest_ = 0.0;
};

}  // namespace lamplighter
