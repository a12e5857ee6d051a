#include "editor/session/frame_pacer.h"

#include <algorithm>
#include <optional>

#include "editor/session/session.h"
#include "renderer/methods/common_parameters.h"

namespace lamplighter {

void FramePacer::renderFrame(Session& session) {
  const auto budget = frameBudgetParameters().read(session.document().render.values);
  if (budget.frameTime == 0.0f) {
    session.renderFrame(std::nullopt, {.refineUpdates = budget.updates});
  } else {
    const FrameTimeControl::Work work = control_.within(1e-3 * budget.frameTime);
    session.renderFrame(std::min(budget.updates, work.updates),
                        {.inBackground = true,
                         .refineUpdates = work.refineUpdates,
                         .previewUpdates = work.previewUpdates,
                         .previewFrames = work.previewFrames,
                         .surfaceWork = work.surfaces});
  }
  control_.measured(session.output().stats);
}

}  // namespace lamplighter
