// Tools that tell of the point that is clicked: why it is dark, how bright it is, how far it is
// from another. None of them is part of the work: no undo, nothing saved.
#pragma once

#include <optional>

#include "editor/explain/explainer.h"
#include "editor/explain/measurement.h"
#include "editor/explain/probe.h"
#include "editor/tools/viewport_input.h"
#include "renderer/frame/frame.h"

namespace lamplighter {

// What a click into the picture asks, before it selects.
enum class PointTool { none, explain, measure };

class PointTools {
 public:
  // What they look at, all of one frame.
  struct Subject {
    const Scene& scene;
    const FrameRenderer& renderer;
    const View& view;
    const Settings& settings;
    RadianceImage* lit = nullptr;  // the lit picture; null while another is shown
  };

  PointTool tool() const { return tool_; }
  void setTool(PointTool tool);
  // Another level: nothing of the old one is told any more.
  void forget();

  // Each in viewport pixels; throws InputError where there is no surface.
  void explainAt(const Subject& subject, const vec2& pixel);
  void measureAt(const Subject& subject, const vec2& pixel);
  const Reading& probeAt(const Subject& subject, const vec2& pixel);

  bool probesPointer() const { return probesPointer_; }
  void probePointer(bool on);
  // Of the pixel that was last asked for; none: nothing is.
  const std::optional<Reading>& reading() const { return reading_; }
  Explainer& explainer() { return explainer_; }
  const Explainer& explainer() const { return explainer_; }
  Measurement& measurement() { return measurement_; }
  const Measurement& measurement() const { return measurement_; }

  // The pointer over the viewport. True when a click is theirs.
  bool pointer(const Subject& subject, const ViewportInput& input);
  // A frame was rendered. `pictureChanged`: it differs from the one before; `sceneChanged`: so does
  // the level.
  void update(const Subject& subject, bool pictureChanged, bool sceneChanged);
  void draw(Overlay& overlay, const Subject& subject) const;

 private:
  const LightSamples& samples(const Subject& subject) const;
  PickedPoint pointAt(const Subject& subject, const vec2& pixel) const;

  PointTool tool_ = PointTool::none;
  Explainer explainer_;
  Measurement measurement_;
  bool probesPointer_ = false;
  std::optional<vec2> pointerAt_;  // while it is probed
  std::optional<Reading> reading_;
  mutable std::optional<LightSamples> samples_;  // of this frame, once they are asked for
  bool ownSamples_ = false;                      // they are not the method's
  Settings settings_;                            // that they were made with
};

}  // namespace lamplighter
