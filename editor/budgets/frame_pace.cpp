#include "editor/budgets/frame_pace.h"

#include <algorithm>

#include "renderer/methods/common_parameters.h"

namespace lamplighter {

FramePace::Frame FramePace::next(const Settings& settings) {
  const auto budget = frameBudgetParameters().read(settings);
  if (budget.frameTime == 0.0f) return {std::nullopt, {.refineUpdates = budget.updates}};
  const FrameTimeControl::Work work = control_.within(1e-3 * budget.frameTime);
  return {std::min(budget.updates, work.updates),
          {.inBackground = true,
           .refineUpdates = work.refineUpdates,
           .previewUpdates = work.previewUpdates,
           .previewFrames = work.previewFrames,
           .surfaceWork = work.surfaces}};
}

}  // namespace lamplighter
