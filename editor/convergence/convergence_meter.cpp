#include "editor/convergence/convergence_meter.h"

#include "renderer/base/error.h"

namespace lamplighter {

std::optional<double> Convergence::secondsToStayBelow(double limit) const {
  std::optional<double> seconds;
  // Searches backwards from the end while the error is below the limit. NaN is not.
  for (auto sample = curve.rbegin(); sample != curve.rend() && sample->error < limit; ++sample)
    seconds = sample->seconds;
  return seconds;
}

std::vector<Convergence::Sample> Convergence::thinnedCurve(double factor) const {
  std::vector<Sample> kept;
  for (const Sample& sample : curve) {
    const bool isLast = &sample == &curve.back();
    if (kept.empty() || isLast || sample.seconds >= factor * kept.back().seconds)
      kept.push_back(sample);
  }
  return kept;
}

void ConvergenceMeter::render() {
  pacer_.renderFrame(session_);
  session_.renderer().backend().finish();
  if (!session_.renderError().empty()) throw InputError(session_.renderError());
}

double ConvergenceMeter::frame(const std::function<void()>& edit) {
  const double begin = clock_();
  edit();
  render();
  return clock_() - begin;
}

Convergence ConvergenceMeter::measure(const std::function<void()>& edit, const ErrorOf& errorOf,
                                      std::optional<double> limit) {
  Convergence result;
  double seconds = 0.0;
  double begin = clock_();
  edit();
  for (bool ends = false; !ends;) {
    render();
    seconds += clock_() - begin;

    const GiOutput& output = session_.output();
    if (result.frames++ == 0) result.firstFrame = seconds;
    if (output.settled && !result.settled) result.settled = seconds;
    for (const auto& [stage, time] : output.stats.stageSeconds)
      result.stageSeconds[std::string(stage.name)] += time;
    if (errorOf) result.curve.push_back({seconds, errorOf(output.radiance->pixels())});
    ends = output.settled && (!limit || output.refined);
    ends = ends || (limit && seconds >= *limit);
    begin = clock_();
  }
  return result;
}

}  // namespace lamplighter
