#include "editor/session/lighting_state.h"

#include "editor/session/session.h"

namespace lamplighter {

std::vector<LightRow> LightTable::rows(const Session& session, LightUnit unit) {
  const GiOutput& output = session.output();
  double seconds = 0.0;
  for (const auto& [stage, s] : output.stats.stageSeconds) seconds += s;
  if (!output.settled && session.frame() != frame_)
    lightSeconds_ = lightSeconds_ > 0.0 ? glm::mix(lightSeconds_, seconds, 0.1) : seconds;
  if (!known_ || scene_ != session.sceneRevision()) {
    scene_ = session.sceneRevision();
    shares_ = fluxShares(session.renderScene());
  }
  const bool settledNow = output.settled && !wasSettled_;
  if (!known_ || settledNow || (!output.settled && session.frame() % kFrames == 0))
    figures_ = lightFigures(session.inspect(), lightSeconds_);
  known_ = true;
  wasSettled_ = output.settled;
  frame_ = session.frame();

  std::vector<LightRow> rows = lightRows(session.document(), unit);
  for (LightRow& r : rows) {
    if (const auto f = figures_.find(r.source.node); f != figures_.end()) r.figures = f->second;
    const auto share = shares_.find(r.source.node);
    r.figures.share = share == shares_.end() ? 0.0 : share->second;
  }
  return rows;
}

}  // namespace lamplighter
