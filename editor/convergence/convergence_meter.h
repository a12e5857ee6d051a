// Measures how fast the live picture approaches a reference after an edit.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "editor/session/frame_pacer.h"
#include "editor/session/session.h"

namespace lamplighter {

// The error of the picture over the time since an edit. All times are in seconds from the edit to
// the end of a frame, without the time of comparisons.
struct Convergence {
  struct Sample {
    double seconds = 0.0;
    double error = 0.0;
  };
  int frames = 0;
  double firstFrame = 0.0;                     // the first frame that shows the edit
  std::optional<double> settled;               // none: the time limit came first
  std::vector<Sample> curve;                   // of every frame; empty: nothing was compared
  std::map<std::string, double> stageSeconds;  // of all frames, by stage

  // The time at which the error fell permanently below `limit`. None: it did not.
  std::optional<double> secondsToStayBelow(double limit) const;
  // The first and the last sample, and at most one of the samples between for each `factor` of
  // time.
  std::vector<Sample> thinnedCurve(double factor) const;
};

class ConvergenceMeter {
 public:
  // The session must outlive this object. Its renderer must measure its stages with a clock.
  ConvergenceMeter(Session& session, Stopwatch clock)
      : session_(session), clock_(std::move(clock)) {}

  using ErrorOf = std::function<double(const Image& picture)>;
  // Performs `edit` and renders frames as the editor's window does: until the picture is settled
  // or, with a time limit, for `limit` seconds, in which a settled picture is refined. `errorOf`:
  // compares the picture of a frame; null: none. Throws InputError if a frame cannot be rendered.
  Convergence measure(const std::function<void()>& edit, const ErrorOf& errorOf,
                      std::optional<double> limit = {});
  // Performs `edit` and renders one frame as the editor's window does. Returns the seconds of the
  // frame. Throws InputError if the frame cannot be rendered.
  double frame(const std::function<void()>& edit);

 private:
  void render();

  Session& session_;
  Stopwatch clock_;
  FramePacer pacer_;
};

}  // namespace lamplighter
