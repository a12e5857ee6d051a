// Shows several pictures of the same view: two side by side with a divider, their difference, or
// any number as tiles. Each side is the live picture, another method, or the same method with other
// parameters.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "editor/debug_views/look.h"
#include "editor/error_meter/error_meter.h"
#include "editor/split/compared_side.h"
#include "editor/split/tile_errors.h"
#include "editor/split/tile_layout.h"
#include "editor/split/tile_sheet.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

class SplitView {
 public:
  using MakeRenderer = ComparedSide::MakeRenderer;
  // Creates the renderer of each side but the first on demand.
  void setRenderer(MakeRenderer make) { make_ = std::move(make); }

  enum class Shown { both, first, second, heat, tiles };
  bool on() const { return on_; }
  bool showsTiles() const { return on_ && shown_ == Shown::tiles; }
  Shown shown() const { return shown_; }
  void setShown(Shown shown) { shown_ = shown; }
  // others: at least one. Only tiles show more than one.
  void turnOn(SplitSide first, std::vector<SplitSide> others);
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
  const SplitSide& second() const;  // the first if it is off

  // The first side's frame was rendered before.
  struct Frame {
    ComparedSide::Frame side;
    const SceneChanges& changes;
    const GiOutput& first;
    double seconds = 0.0;  // of the first side's frame
    const ErrorMeter& meter;
  };
  // Renders the second side or, with tiles, the next one that has work left: however many there
  // are, a frame is not longer than with two. If the second side is the reference with default
  // parameters and a worker already traces it, the worker's picture is used. Throws what the second
  // side's renderer throws; a tile shows the reason instead.
  void frame(const Frame& frame);
  bool settled() const { return !on_ || settled_; }
  bool refined() const { return !on_ || refined_; }
  // Null: none yet. Has the size of the view.
  std::shared_ptr<RadianceImage> secondPicture() const { return picture(1); }
  // Null unless the heat map is shown.
  const std::shared_ptr<const ViewPicture>& heat() const { return heat_; }
  // The display-referred picture of the viewport. `first`: the first side's display-referred
  // picture.
  Image8 compose(const Image8& first, float exposureEv, ToneMapper mapper) const;

  // All sides, also those that are not shown. `side` counts from 0, the first.
  size_t sides() const { return on_ ? 1 + others_.size() : 0; }
  std::shared_ptr<RadianceImage> picture(size_t side) const;
  std::string title(size_t side) const;
  std::vector<std::string> figures(size_t side) const;  // lines of text under its tile
  TileLayout layout(const glm::ivec2& area) const {
    return layOutTiles(area, static_cast<int>(sides()), lineHeight_);
  }
  void setLineHeight(float pixels) { lineHeight_ = pixels; }  // of the text under tiles
  TilePointer& pointer() { return pointer_; }
  // All sides with their figures, as one picture. Waits for pictures on a GPU. Throws InputError if
  // the font is missing.
  Image8 sheet(const Image8& first, int columns, float exposureEv, ToneMapper mapper);

 private:
  void renderSecond(const Frame& frame);
  void renderTile(const Frame& frame);
  void makeHeat();
  void compare(bool waits);
  std::vector<Tile> tiles(const Image8& first, float exposureEv, ToneMapper mapper) const;
  size_t baseSide() const;  // errors are the distance from it: the reference, or else the last

  MakeRenderer make_;
  bool on_ = false, settled_ = false, refined_ = false, hot_ = false, dragging_ = false;
  Shown shown_ = Shown::both;
  float position_ = 0.5f, heatScale_ = 0.5f;
  float lineHeight_ = look::kFontSize;
  TilePointer pointer_;
  SplitSide first_;
  std::vector<ComparedSide> others_;
  size_t next_ = 0;  // the tile that is rendered next, if it has work left
  // State of the first side in the last frame.
  std::shared_ptr<RadianceImage> firstPicture_;
  SideInput firstSeen_;
  SideProgress firstProgress_;
  std::string liveMethod_;
  TileErrors errors_;
  std::shared_ptr<const ReferenceHalves> taken_;  // the second picture's, if it is the meter's
  std::shared_ptr<const ViewPicture> heat_;
  // The two pictures that heat_ compares.
  std::shared_ptr<RadianceImage> heatFirst_, heatSecond_;
  float heatFor_ = 0.0f;
};

}  // namespace lamplighter
