// Frames with the default budgets of the editor's window, and the latency of edits.
#pragma once

#include <memory>
#include <string>

#include "editor/budgets/frame_pace.h"
#include "editor/latency/edit_latency.h"
#include "renderer/frame/frame.h"

namespace lamplighter {

double benchSeconds();  // of a steady clock

class WindowFrames {
 public:
  explicit WindowFrames(std::unique_ptr<Backend> backend);

  // Renders a frame. `edit`: its name, if the changes are an edit.
  const GiOutput& frame(const Scene& scene, const SceneChanges& changes, const View& view,
                        const std::string& edit = "");
  // Renders frames until the picture is settled.
  void settle(const Scene& scene, const SceneChanges& changes, const View& view,
              const std::string& edit = "");

  double lastFrame() const { return last_; }  // seconds
  const EditLatency& latency() const { return latency_; }
  Backend& backend() { return renderer_.backend(); }

 private:
  FrameRenderer renderer_;
  Settings settings_;
  FramePace pace_;
  EditLatency latency_;
  GiOutput output_;
  double last_ = 0.0;
};

}  // namespace lamplighter
