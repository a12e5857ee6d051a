// Measures the error of the live picture during editing: it requests the reference, receives it,
// and estimates the error of the picture. It does not trace paths itself: a worker of the ui does
// that in parallel with the frames, or measure() does it at once.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "editor/document/document.h"
#include "editor/error_meter/error_estimate.h"
#include "renderer/methods/gi_method.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

class ErrorMeter {
 public:
  // On: a worker traces the reference in parallel with the frames.
  bool on() const { return on_; }
  void setOn(bool on) { on_ = on; }
  int block() const { return block_; }
  void setBlock(int pixels) { block_ = pixels; }

  // Call after each frame with its picture and the scene's changes since the last frame. A change
  // that would change the reference restarts it.
  void frame(const Document& document, const View& view, bool lightOnly,
             const SceneChanges& changes, const GiOutput& output);

  // Call instead of frame() when the picture is one that the path tracer cannot reproduce.
  void pause();

  // What a worker should trace now. Null: nothing.
  std::shared_ptr<const MeterSubject> wanted() const { return on_ ? subject_ : nullptr; }
  // Receives the result of a worker. A result for another subject is outdated and is discarded.
  void take(std::shared_ptr<const ReferenceHalves> halves);
  // After the next frame, traces this number of paths per block and compares at once.
  void measureAtOnce(int samples) { toMeasure_ = samples; }
  // true if the last frame did the requested measurement
  bool measured() const { return measured_; }

  // The error of the picture, at most a few frames old. None while there is no reference for the
  // picture.
  const std::optional<ErrorEstimate>& estimate() const { return estimate_; }
  // The reference so far, in blocks of the subject. Null: none.
  const std::shared_ptr<const ReferenceHalves>& reference() const { return halves_; }
  // Text for the status line: "error 3.1% ± 0.4%". "": the meter is off.
  std::string text() const;

 private:
  void compare(RadianceImage& picture);

  bool on_ = false, stale_ = true, measured_ = false;
  int block_ = 4, toMeasure_ = 0;
  uint64_t numbers_ = 0, levels_ = 0;
  std::shared_ptr<const MeterSubject> subject_;
  std::shared_ptr<const ReferenceHalves> halves_;
  std::shared_ptr<RadianceImage> compared_;  // the picture of the estimate
  bool comparedSettled_ = false;             // whether that picture was settled
  int framesSince_ = 0;                      // frames since the last comparison
  bool isNews_ = false;                      // there are halves that were not compared yet
  std::optional<ErrorEstimate> estimate_;
};

}  // namespace lamplighter
