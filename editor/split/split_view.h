// Two pictures of the same view, side by side with a divider between them, or how far they are
// apart. Each side is the live picture, or another method or the same with other parameters.
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

// "live", or a method's name; either with parameters of its own: "many_lights,vpls=1000".
struct SplitSide {
  std::string text = "live";
  std::string method;  // "": that of the document
  Settings values;     // instead of the document's
  bool isLive() const { return method.empty() && values.values().empty(); }
  RenderSettings of(const RenderSettings& document) const;
};
// Throws InputError for a method or parameter that there is not. `method`: the document's.
SplitSide readSide(const std::string& text, const std::string& method);

class SplitView {
 public:
  // Makes the renderer of the second side when it is first needed.
  using MakeRenderer = std::function<std::unique_ptr<FrameRenderer>()>;
  void setRenderer(MakeRenderer make) { make_ = std::move(make); }

  enum class Shown { both, first, second, heat };
  bool on() const { return on_; }
  Shown shown() const { return shown_; }
  void setShown(Shown shown) { shown_ = shown; }
  void turnOn(SplitSide first, SplitSide second);
  void turnOff();
  // The one side whole, then the other.
  void toggleWhole();
  // A hand on the divider: true when it takes the input. `width`: the view's.
  bool drag(const ViewportInput& input, int width);
  bool hot() const { return hot_; }  // the pointer is on the divider or drags it
  // Of the view's width, left of the divider.
  float position() const { return position_; }
  void setPosition(float share) { position_ = share; }
  // What the heat map's ramp ends at, as a share of the second picture's mean.
  float heatScale() const { return heatScale_; }
  void setHeatScale(float share) { heatScale_ = share; }
  const SplitSide& first() const { return first_; }
  const SplitSide& second() const { return second_; }

  // After the first side's frame. Where the second is the plain reference and a worker traces that
  // already, its picture is taken.
  void frame(const Document& document, const SceneChanges& changes, const View& view,
             bool lightOnly, const GiOutput& first, const ErrorMeter& meter);
  bool settled() const { return !on_ || settled_; }
  // Null: none yet. Of the view's size.
  const std::shared_ptr<RadianceImage>& secondPicture() const { return picture_; }
  // Null unless it is shown.
  const std::shared_ptr<const ViewPicture>& heat() const { return heat_; }
  // What the viewport shows, of the display: `first` as it is shown alone.
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
  std::shared_ptr<const ReferenceHalves> taken_;  // what picture_ was made of, if the meter's
  std::shared_ptr<const ViewPicture> heat_;
  // What heat_ is of.
  std::shared_ptr<RadianceImage> heatFirst_, heatSecond_;
  float heatFor_ = 0.0f;
};

}  // namespace lamplighter
