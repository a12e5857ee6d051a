// The error of the live picture while it is edited: what the reference is to be of, what it gave,
// and how far the picture is from it. Who traces the paths is not its business: a worker of the ui
// beside the frames, or measure() at once.
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
  // On: a worker is to trace the reference beside the frames.
  bool on() const { return on_; }
  void setOn(bool on) { on_ = on; }
  int block() const { return block_; }
  void setBlock(int pixels) { block_ = pixels; }

  // After each frame: its picture, and what the scene changed by since the last one. Whatever
  // changes what the reference would show makes it begin again.
  void frame(const Document& document, const View& view, bool lightOnly,
             const SceneChanges& changes, const GiOutput& output);

  // Instead of frame(): what is shown is nothing that the reference makes.
  void pause();

  // What a worker should trace now; null: nothing.
  std::shared_ptr<const MeterSubject> wanted() const { return on_ ? subject_ : nullptr; }
  // What a worker has traced. Of another subject: it comes too late and is dropped.
  void take(std::shared_ptr<const ReferenceHalves> halves);
  // Traces as many paths a block as that after the next frame and compares at once.
  void measureAtOnce(int samples) { toMeasure_ = samples; }
  bool measured() const { return measured_; }  // in the last frame, since it was asked for

  // Of the picture as it was a few frames ago at most; none while there is no reference for it.
  const std::optional<ErrorEstimate>& estimate() const { return estimate_; }
  // The reference so far; null: none. The subject's blocks.
  const std::shared_ptr<const ReferenceHalves>& reference() const { return halves_; }
  // For the status line: "error 3.1% ± 0.4%"; "": off.
  std::string text() const;

 private:
  void compare(RadianceImage& picture);

  bool on_ = false, stale_ = true, measured_ = false;
  int block_ = 4, toMeasure_ = 0;
  uint64_t numbers_ = 0, levels_ = 0;
  std::shared_ptr<const MeterSubject> subject_;
  std::shared_ptr<const ReferenceHalves> halves_;
  std::shared_ptr<RadianceImage> compared_;  // the picture that the estimate is of
  bool comparedSettled_ = false;             // and whether it was settled
  int framesSince_ = 0;                      // it was compared
  bool isNews_ = false;                      // halves that were not compared yet
  std::optional<ErrorEstimate> estimate_;
};

}  // namespace lamplighter
