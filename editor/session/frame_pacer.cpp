#include "editor/session/frame_pacer.h"

#include <algorithm>
#include <optional>

#include "editor/session/session.h"
#include "renderer/methods/common_parameters.h"

namespace lamplighter {
namespace {

// Reports the refinement work of a frame as if it were refreshes. Its cost per item differs, so its
// rate is controlled separately.
GiStats refinementOf(GiStats stats) {
  stats.updates = stats.refineUpdates;
  return stats;
}

}  // namespace

void FramePacer::renderFrame(Session& session) {
  const auto budget = frameBudgetParameters().read(session.document().render.values);
  const double seconds = 1e-3 * budget.frameTime;
  if (budget.frameTime == 0.0f)
    session.renderFrame(std::nullopt, budget.updates);
  else
    session.renderFrame(std::min(budget.updates, updates_.updatesWithin(seconds)),
                        std::min(budget.updates, refinement_.updatesWithin(seconds)));
  updates_.measured(session.output().stats);
  refinement_.measured(refinementOf(session.output().stats));
}

}  // namespace lamplighter
