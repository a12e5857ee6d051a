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

// The time of the second picture is not part of the frame.
void Session::watchFrame(const SceneChanges& changes, double begin) {
  const double end = clock_ ? clock_() : 0.0;
  watch_.timeline.add(frame_, begin, end, output_.stats);
  RenderSettings shown = document_.render;
  shown.exposureEv = watch_.shown.exposureEv;  // shows the same picture
  const bool edited = !changes.none() || !(shown == watch_.shown);
  watch_.shown = std::move(shown);
  watch_.latency.frame({edited && !changes.everything, history().undoLabel(), output_.settled,
                        view_, output_.radiance, begin, end});
  // The reference has no work light, and always shows all parts of the light.
  if (display_.part() == LightPart::all && !lighting_.workLight)
    watch_.meter.frame(document_, view_, display_.lightOnly(), changes, output_);
  else
    watch_.meter.pause();
  if (watch_.meter.measured()) setStatus(watch_.meter.text());
  try {
    split_.frame(document_, changes, view_, display_.lightOnly(), output_, watch_.meter);
  } catch (const std::exception& e) {
    split_.turnOff();  // the first side was rendered and stays
    setStatus("Split view: " + failureText(e), NoticeKind::error);
  }
  output_.settled = output_.settled && split_.settled();
}

Image8 Session::picture() const {
  const auto& view = display_.picture();
  const float ev = document_.render.exposureEv;
  if (split_.on() && split_.heat()) return split_.heat()->image;
  const ToneMapper mapper = display_.toneMapper();
  return split_.compose(view ? view->image : toneMap(output_.radiance->pixels(), ev, mapper), ev,
                        mapper);
}

}  // namespace lamplighter
