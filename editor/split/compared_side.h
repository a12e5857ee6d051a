// An additional picture of the view, with its own renderer and its time.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "editor/budgets/frame_pace.h"
#include "editor/split/split_side.h"
#include "renderer/frame/frame.h"

namespace lamplighter {

// The input of a picture in addition to the scene. The exposure is applied when it is shown.
struct SideInput {
  View view;
  RenderSettings settings;
  bool lightOnly = false;
  bool operator==(const SideInput&) const = default;
};

// The work on a picture since the last edit or motion of the camera.
class SideProgress {
 public:
  // Records the duration of a frame. `isNew`: it was the first after an edit.
  void frame(bool isNew, double seconds, bool settled);
  // "settled after 3.21 s, 25 frames"; without a clock there are no seconds.
  std::string text() const;

 private:
  double seconds_ = 0.0;
  int frames_ = 0;
  bool settled_ = false;
};

class ComparedSide {
 public:
  using MakeRenderer = std::function<std::unique_ptr<FrameRenderer>()>;
  struct Frame {
    const Document& document;
    const View& view;
    bool lightOnly = false;
    bool isPaced = false;  // by time, as in the window; otherwise by counts, and not refined
    Stopwatch clock;       // null: times are not measured
    SideInput of(const SplitSide& side) const;
  };

  explicit ComparedSide(SplitSide side) : side_(std::move(side)) {}
  const SplitSide& side() const { return side_; }
  const SideProgress& progress() const { return progress_; }

  // The next frame that is rendered, this one or a later one, receives these changes.
  void note(const SceneChanges& changes, const Frame& frame);
  // Whether further frames leave the picture unchanged.
  bool isDone(const Frame& frame) const;
  // Renders a frame; throws the exceptions of the renderer. `make`: creates the renderer on demand.
  void render(const Frame& frame, const MakeRenderer& make);
  // Shows a picture that another renderer made, and frees the own renderer.
  void show(std::shared_ptr<RadianceImage> picture, bool settled);
  // Shows nothing until something changes. `why`: text instead of the progress.
  void fail(std::string why, const Frame& frame);

  bool settled() const { return settled_; }
  bool refined() const { return refined_; }
  const std::string& failure() const { return failure_; }                     // "": none
  const std::shared_ptr<RadianceImage>& picture() const { return picture_; }  // null: none yet

 private:
  bool isNew(const Frame& frame) const;

  SplitSide side_;
  std::unique_ptr<FrameRenderer> renderer_;
  FramePace pace_;
  SceneChanges unseen_ = SceneChanges::all();
  SideInput seen_;  // of the last frame
  bool settled_ = false, refined_ = false;
  std::shared_ptr<RadianceImage> picture_;
  SideProgress progress_;
  std::string failure_;
};

}  // namespace lamplighter
