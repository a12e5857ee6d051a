// Shows two pictures of the same view side by side with a divider, or their difference. Each side
// is the live picture, another method, or the same method with other parameters.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "editor/document/document.h"
#include "editor/error_meter/error_meter.h"
#include "editor/tools/viewport_input.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/frame/frame.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

// "live" or the name of a method; either may have its own parameters: "many_lights,vpls=1000".
struct SplitSide {
  std::string text = "live";
  std::string method;  // "": the document's method
  Settings values;     // override the document's values
  bool isLive() const { return method.empty() && values.values().empty(); }
  RenderSettings of(const RenderSettings& document) const;
};
// Throws InputError for an unknown method or parameter. `method`: the document's.
SplitSide readSide(const std::string& text, const std::string& method);

class SplitView {
 public:
  // Creates the renderer of the second side on demand.
  using MakeRenderer = std::function<std::unique_ptr<FrameRenderer>()>;
  void setRenderer(MakeRenderer make) { make_ = std::move(make); }

  enum class Shown { both, first, second, heat };
  bool on() const { return on_; }
  Shown shown() const { return shown_; }
  void setShown(Shown shown) { shown_ = shown; }
  void turnOn(SplitSide first, SplitSide second);
  void turnOff();
  // Shows the second side over the whole view or, if it is shown already, the first side.
  void toggleWhole();
  // Handles a drag of the divider. Returns true if it used the input. `width`: of the view.
  bool drag(const ViewportInput& input, int width);
  bool hot() const { return hot_; }  // the pointer is on the divider or drags it
  // Position of the divider, as a fraction of the view's width.
  float position() const { return position_; }
  void setPosition(float share) { position_ = share; }
  // End of the heat map's ramp, relative to the mean of the second picture.
  float heatScale() const { return heatScale_; }
  void setHeatScale(float share) { heatScale_ = share; }
  const SplitSide& first() const { return first_; }
  const SplitSide& second() const { return second_; }

  // Call after the frame of the first side. If the second side is the reference with default
  // parameters and a worker already traces it, the worker's picture is used.
  void frame(const Document& document, const SceneChanges& changes, const View& view,
             bool lightOnly, const GiOutput& first, const ErrorMeter& meter);
  bool settled() const { return !on_ || settled_; }
  // Null: none yet. Has the size of the view.
  const std::shared_ptr<RadianceImage>& secondPicture() const { return picture_; }
  // Null unless the heat map is shown.
  const std::shared_ptr<const ViewPicture>& heat() const { return heat_; }
  // The display-referred picture of the viewport. `first`: the first side's display-referred
  // picture.
  Image8 compose(const Image8& first, float exposureEv, ToneMapper mapper) const;

 private:
  void makeHeat(RadianceImage& first);

  MakeRenderer make_;
  std::unique_ptr<FrameRenderer> renderer_;
  bool on_ = false, fresh_ = true, settled_ = false, hot_ = false, dragging_ = false;
  Shown shown_ = Shown::both;
  float position_ = 0.5f, heatScale_ = 0.5f;
  SplitSide first_, second_;
  std::shared_ptr<RadianceImage> picture_;
  std::shared_ptr<const ReferenceHalves> taken_;  // source of picture_ if it comes from the meter
  std::shared_ptr<const ViewPicture> heat_;
  // The two pictures that heat_ compares.
  std::shared_ptr<RadianceImage> heatFirst_, heatSecond_;
  float heatFor_ = 0.0f;
};

}  // namespace lamplighter
