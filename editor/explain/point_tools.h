// Tools that inspect a clicked point: why it is dark, how bright it is, and its distance from
// another point. They are not part of the document: they have no undo and are not saved.
#pragma once

#include <optional>

#include "editor/explain/explainer.h"
#include "editor/explain/measurement.h"
#include "editor/explain/probe.h"
#include "editor/tools/viewport_input.h"
#include "renderer/frame/frame.h"

namespace lamplighter {

// The tool that handles a click in the picture before the selection does.
enum class PointTool { none, explain, measure };

class PointTools {
 public:
  // The data that the tools inspect, all of the same frame.
  struct Subject {
    const Scene& scene;
    const FrameRenderer& renderer;
    const View& view;
    const Settings& settings;
    RadianceImage* lit = nullptr;  // the lit picture; null while another is shown
  };

  PointTool tool() const { return tool_; }
  void setTool(PointTool tool);
  // Call when another level is opened: clears all results of the old one.
  void forget();

  // Positions in viewport pixels. Both throw InputError if there is no surface.
  void explainAt(const Subject& subject, const vec2& pixel);
  void measureAt(const Subject& subject, const vec2& pixel);
  const Reading& probeAt(const Subject& subject, const vec2& pixel);

  bool probesPointer() const { return probesPointer_; }
  void probePointer(bool on);
  // The reading of the last probed pixel. None: no pixel is probed.
  const std::optional<Reading>& reading() const { return reading_; }
  Explainer& explainer() { return explainer_; }
  const Explainer& explainer() const { return explainer_; }
  Measurement& measurement() { return measurement_; }
  const Measurement& measurement() const { return measurement_; }

  // Handles the pointer over the viewport. Returns true if the tools used the click.
  bool pointer(const Subject& subject, const ViewportInput& input);
  // Call after each rendered frame. `pictureChanged`: the picture differs from the last frame's;
  // `sceneChanged`: the level does.
  void update(const Subject& subject, bool pictureChanged, bool sceneChanged);
  void draw(Overlay& overlay, const Subject& subject) const;

 private:
  const LightSamples& samples(const Subject& subject) const;
  PickedPoint pointAt(const Subject& subject, const vec2& pixel) const;

  PointTool tool_ = PointTool::none;
  Explainer explainer_;
  Measurement measurement_;
  bool probesPointer_ = false;
  std::optional<vec2> pointerAt_;  // while the pixel is probed
  std::optional<Reading> reading_;
  mutable std::optional<LightSamples> samples_;  // samples of this frame, created on demand
  bool ownSamples_ = false;                      // they are not the method's samples
  Settings settings_;                            // settings that they were created with
};

}  // namespace lamplighter
