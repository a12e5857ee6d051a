#include "editor/explain/point_tools.h"

#include "editor/explain/quantity.h"
#include "renderer/base/error.h"

namespace lamplighter {

void PointTools::setTool(PointTool tool) {
  if (tool_ == PointTool::measure && tool != tool_) measurement_.clear();
  tool_ = tool;
}

void PointTools::forget() {
  explainer_.close();
  measurement_.clear();
  reading_.reset();
  samples_.reset();
}

const LightSamples& PointTools::samples(const Subject& s) const {
  if (!samples_)
    samples_ =
        lightSamples(s.renderer.inspect(), s.renderer.scene(), *s.renderer.rays(), s.settings);
  return *samples_;
}

PickedPoint PointTools::pointAt(const Subject& s, const vec2& pixel) const {
  if (s.renderer.rays() == nullptr)
    throw InputError("point", "nothing is rendered yet", "wait for the first picture");
  const auto point = surfaceAt(s.renderer.scene(), *s.renderer.rays(), s.view, pixel);
  if (!point)
    throw InputError("point " + threeDigits(pixel.x) + " " + threeDigits(pixel.y),
                     "there is no surface", "point at a surface");
  return *point;
}

void PointTools::explainAt(const Subject& s, const vec2& pixel) {
  const PickedPoint point = pointAt(s, pixel);
  explainer_.ask(s.scene, s.renderer.scene(), *s.renderer.rays(), point, samples(s),
                 s.renderer.inspect());
}

void PointTools::measureAt(const Subject& s, const vec2& pixel) {
  measurement_.add(pointAt(s, pixel).position);
  measurement_.hover({});
}

const Reading& PointTools::probeAt(const Subject& s, const vec2& pixel) {
  if (s.renderer.rays() == nullptr)
    throw InputError("point", "nothing is rendered yet", "wait for the first picture");
  reading_ = probe(s.scene, s.renderer.scene(), *s.renderer.rays(), s.view, pixel, samples(s),
                   s.lit != nullptr ? &s.lit->pixels() : nullptr);
  return *reading_;
}

void PointTools::probePointer(bool on) {
  probesPointer_ = on;
  reading_.reset();
  pointerAt_.reset();
}

bool PointTools::pointer(const Subject& s, const ViewportInput& input) {
  if (s.renderer.rays() == nullptr) return false;
  pointerAt_.reset();
  if (input.hovered) pointerAt_ = input.pointer;
  if (tool_ == PointTool::none) return false;
  const auto under = input.hovered
                         ? surfaceAt(s.renderer.scene(), *s.renderer.rays(), s.view, input.pointer)
                         : std::nullopt;
  if (tool_ == PointTool::measure)
    measurement_.hover(under ? std::optional(under->position) : std::nullopt);
  if (!input.hovered || !input.pressed[0]) return true;
  if (!under) {
    // The click hit the sky: closes the explanation.
    if (tool_ == PointTool::explain) explainer_.close();
    return true;
  }
  if (tool_ == PointTool::explain) explainAt(s, input.pointer);
  if (tool_ == PointTool::measure) measureAt(s, input.pointer);
  return true;
}

void PointTools::update(const Subject& s, bool pictureChanged, bool sceneChanged) {
  if (s.renderer.rays() == nullptr) return;
  if (explainer_.answer() == nullptr && !probesPointer_) {
    samples_.reset();
    return;
  }
  // Samples created by the tools depend only on the level, not on the progress of the picture.
  const bool methodHasThem = !s.renderer.inspect().lights.empty();
  const bool outdated = methodHasThem ? pictureChanged || ownSamples_
                                      : sceneChanged || !ownSamples_ || !(settings_ == s.settings);
  if (outdated) {
    samples_.reset();
    ownSamples_ = !methodHasThem;
    settings_ = s.settings;
    if (explainer_.answer() != nullptr)
      explainer_.askAgain(s.scene, s.renderer.scene(), *s.renderer.rays(), samples(s),
                          s.renderer.inspect());
  }
  if (!probesPointer_) return;
  if (!pointerAt_)
    reading_.reset();
  else if (pictureChanged || outdated || !reading_ || reading_->pixel != *pointerAt_)
    probeAt(s, *pointerAt_);
}

void PointTools::draw(Overlay& overlay, const Subject& s) const {
  if (s.renderer.rays() == nullptr) return;
  if (explainer_.answer() != nullptr)
    explainer_.draw(overlay, s.view, s.renderer.scene(), *s.renderer.rays(), samples(s));
  measurement_.draw(overlay, s.view);
  // The measured distance replaces the reading here; the status line still shows the reading.
  if (tool_ == PointTool::measure) return;
  if (probesPointer_ && reading_ && (reading_->lux || reading_->nits)) {
    const std::string lux = reading_->lux ? luxText(*reading_->lux) : "";
    const std::string nits = reading_->nits ? nitsText(*reading_->nits) : "";
    overlay.texts.push_back({reading_->pixel + vec2(18.0f, 10.0f),
                             lux + (lux.empty() || nits.empty() ? "" : "\n") + nits,
                             vec4(1.0f, 1.0f, 1.0f, 1.0f), true});
  }
}

}  // namespace lamplighter
