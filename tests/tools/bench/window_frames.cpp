#include "tests/tools/bench/window_frames.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "renderer/methods/common_parameters.h"

namespace lamplighter {

double benchSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

WindowFrames::WindowFrames(std::unique_ptr<Backend> backend)
    : renderer_(std::move(backend), benchSeconds) {}

const GiOutput& WindowFrames::frame(const Scene& scene, const SceneChanges& changes,
                                    const View& view, const std::string& edit) {
  const FramePace::Frame paced = pace_.next(settings_);
  Settings now = settings_;
  if (paced.updates) now.set(kUpdates, *paced.updates);
  const double begin = benchSeconds();
  output_ = renderer_.render({scene, changes, view, "many_lights", now, false, paced.budget});
  renderer_.backend().finish();
  const double end = benchSeconds();
  last_ = end - begin;
  pace_.measured(output_.stats);
  latency_.frame({!edit.empty(), edit, output_.settled, view, output_.radiance, begin, end});
  return output_;
}

void WindowFrames::settle(const Scene& scene, const SceneChanges& changes, const View& view,
                          const std::string& edit) {
  frame(scene, changes, view, edit);
  while (!output_.settled) frame(scene, {}, view);
}

}  // namespace lamplighter
