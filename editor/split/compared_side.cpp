#include "editor/split/compared_side.h"

#include <utility>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/methods/common_parameters.h"

namespace lamplighter {

void SideProgress::frame(bool isNew, double seconds, bool settled) {
  if (isNew) *this = {};
  if (settled_) return;  // later frames refine the picture
  seconds_ += seconds;
  ++frames_;
  settled_ = settled;
}

std::string SideProgress::text() const {
  const std::string frames = frames_ == 1 ? "1 frame" : fmt::format("{} frames", frames_);
  return (settled_ ? "settled after " : "") +
         (seconds_ > 0.0 ? fmt::format("{:.2f} s, {}", seconds_, frames) : frames);
}

SideInput ComparedSide::Frame::of(const SplitSide& side) const {
  SideInput input{view, side.of(document.render), lightOnly};
  input.settings.exposureEv = 0.0f;
  return input;
}

bool ComparedSide::isNew(const Frame& frame) const {
  return !unseen_.none() || !(frame.of(side_) == seen_);
}

void ComparedSide::note(const SceneChanges& changes, const Frame& frame) {
  unseen_.merge(changes);
  if (isNew(frame)) progress_ = {};
}

bool ComparedSide::isDone(const Frame& frame) const {
  return !isNew(frame) && (!failure_.empty() || (settled_ && (refined_ || !frame.isPaced)));
}

void ComparedSide::render(const Frame& frame, const MakeRenderer& make) {
  if (!renderer_) {
    renderer_ = make ? make() : std::make_unique<FrameRenderer>(makeCpuBackend());
    unseen_ = SceneChanges::all();
  }
  const double begin = frame.clock ? frame.clock() : 0.0;
  const bool begins = isNew(frame);
  SideInput input = frame.of(side_);
  Settings settings = input.settings.values;
  const FramePace::Frame paced = frame.isPaced ? pace_.next(settings) : FramePace::Frame();
  if (paced.updates) settings.set(kUpdates, *paced.updates);
  const GiOutput out =
      renderer_->render({frame.document.scene, unseen_, frame.view, input.settings.method, settings,
                         frame.lightOnly, paced.budget});
  if (frame.isPaced) pace_.measured(out.stats);
  seen_ = std::move(input);
  unseen_ = {};
  picture_ = out.radiance;
  settled_ = out.settled;
  refined_ = out.refined;
  failure_.clear();
  progress_.frame(begins, frame.clock ? frame.clock() - begin : 0.0, settled_);
}

void ComparedSide::show(std::shared_ptr<RadianceImage> picture, bool settled) {
  renderer_.reset();
  if (picture) picture_ = std::move(picture);
  settled_ = refined_ = settled;
  progress_ = {};
}

void ComparedSide::fail(std::string why, const Frame& frame) {
  renderer_.reset();  // what it keeps may be inconsistent
  picture_.reset();
  seen_ = frame.of(side_);
  unseen_ = {};
  settled_ = refined_ = true;
  failure_ = std::move(why);
}

}  // namespace lamplighter
