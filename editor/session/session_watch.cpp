// A session after a frame was rendered: measurements and the second picture of the split view.
#include "editor/notices/failure_text.h"
#include "editor/session/session.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

// In the window the work follows the time that it takes; without a clock it is the same in each
// frame.
void Session::updateProbes(const SceneChanges& changes, bool isTimed) {
  const double begin = clock_ ? clock_() : 0.0;
  probes_.update(renderScene(), *renderer_->rays(), changes);
  if (clock_ && isTimed) probes_.took(clock_() - begin);
}

// The time of the second picture is not part of the frame. Where counts limit the work, tiles show
// no times, so that the pictures of a recording are the same in each run.
void Session::watchFrame(const SceneChanges& changes, double begin, bool isPaced) {
  const double end = clock_ ? clock_() : 0.0;
  watch_.timeline.add(frame_, begin, end, output_.stats);
  RenderSettings shown = document_.render;
  shown.exposureEv = watch_.shown.exposureEv;  // shows the same picture
  const bool edited = !changes.none() || !(shown == watch_.shown);
  watch_.shown = std::move(shown);
  watch_.latency.frame({edited && !changes.everything, history().undoLabel(), output_.settled,
                        view_, output_.radiance, begin, end});
  // The reference has no work light, and always shows all parts of the light. With tiles it is one
  // of them.
  if (display_.part() == LightPart::all && !lighting_.workLight && !split_.showsTiles())
    watch_.meter.frame(document_, view_, display_.lightOnly(), changes, output_);
  else
    watch_.meter.pause();
  if (watch_.meter.measured()) setStatus(watch_.meter.text());
  try {
    split_.frame({{document_, view_, display_.lightOnly(), isPaced, isPaced ? clock_ : Stopwatch()},
                  changes,
                  output_,
                  isPaced ? end - begin : 0.0,
                  watch_.meter});
  } catch (const std::exception& e) {
    split_.turnOff();  // the first side was rendered and stays
    setStatus("Split view: " + failureText(e), NoticeKind::error);
  }
  output_.settled = output_.settled && split_.settled();
  output_.refined = output_.refined && split_.refined();
}

Image8 Session::firstPicture() const {
  if (const auto& view = display_.picture()) return view->image;
  return toneMap(output_.radiance->pixels(), document_.render.exposureEv, display_.toneMapper());
}

Image8 Session::sheet() {
  return split_.sheet(firstPicture(), tiles().columns, document_.render.exposureEv,
                      display_.toneMapper());
}

Image8 Session::picture() {
  if (split_.on() && split_.heat()) return split_.heat()->image;
  if (split_.showsTiles()) return sheet();
  return split_.compose(firstPicture(), document_.render.exposureEv, display_.toneMapper());
}

}  // namespace lamplighter
