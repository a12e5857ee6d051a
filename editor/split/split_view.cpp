#include "editor/split/split_view.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "editor/split/heat_map.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/tone_map.h"
#include "renderer/registry/registry.h"

namespace lamplighter {

RenderSettings SplitSide::of(const RenderSettings& document) const {
  RenderSettings settings = document;
  if (!method.empty()) settings.method = method;
  for (const auto& [name, value] : values.values()) settings.values.set(name, value);
  return settings;
}

SplitSide readSide(const std::string& text, const std::string& method) {
  SplitSide side;
  side.text = text;
  std::istringstream in(text);
  std::string part;
  std::getline(in, part, ',');
  if (part != "live") side.method = findMethod(part).name;
  const auto& all = findMethod(side.method.empty() ? method : side.method).parameters;
  while (std::getline(in, part, ',')) {
    const size_t equals = part.find('=');
    const ParameterSpec* spec = findParameter(all, part.substr(0, equals));
    if (equals == std::string::npos || !spec)
      throw InputError(text, "'" + part + "' does not set a parameter of the method",
                       "give live or a method, then ,NAME=VALUE for each parameter");
    side.values.set(spec->name, Settings::parse(*spec, part.substr(equals + 1)));
  }
  return side;
}

void SplitView::turnOn(SplitSide first, SplitSide second) {
  first_ = std::move(first);
  second_ = std::move(second);
  on_ = true;
  shown_ = Shown::both;
  settled_ = false;
  picture_.reset();
  heat_.reset();
}

void SplitView::turnOff() {
  on_ = false;
  fresh_ = true;  // it gets no changes while it is off
  picture_.reset();
  taken_.reset();
  heat_.reset();
  heatFirst_.reset();
  heatSecond_.reset();
  renderer_.reset();  // frees its shadow maps and copies of the scene
}

bool SplitView::drag(const ViewportInput& input, int width) {
  constexpr float kReach = 6.0f;  // pixels to either side
  const bool divides = on_ && shown_ == Shown::both;
  if (!divides || !input.down[0]) dragging_ = false;
  const float from = std::abs(input.pointer.x - position_ * static_cast<float>(width));
  const bool free = input.hovered && !input.down[1] && !input.down[2];
  hot_ = divides && (dragging_ || (free && from <= kReach && (!input.down[0] || input.pressed[0])));
  if (hot_ && input.pressed[0]) dragging_ = true;
  if (dragging_)
    position_ = std::clamp(input.pointer.x / static_cast<float>(std::max(width, 1)), 0.0f, 1.0f);
  return dragging_;
}

void SplitView::toggleWhole() { shown_ = shown_ == Shown::second ? Shown::first : Shown::second; }

void SplitView::frame(const Document& document, const SceneChanges& changes, const View& view,
                      bool lightOnly, const GiOutput& first, const ErrorMeter& meter) {
  if (!on_) return;
  const RenderSettings settings = second_.of(document.render);
  if (meter.on() && settings.method == "reference" && second_.values.values().empty()) {
    settled_ = meter.reference() != nullptr;
    if (meter.reference() && meter.reference() != taken_) {
      taken_ = meter.reference();
      picture_ = std::make_shared<HostImage>(enlarged(taken_->mean(), view.width, view.height));
    }
    fresh_ = true;
  } else {
    taken_.reset();
    if (!renderer_) {
      renderer_ = make_ ? make_() : std::make_unique<FrameRenderer>(makeCpuBackend());
      fresh_ = true;
    }
    const SceneChanges seen = std::exchange(fresh_, false) ? SceneChanges::all() : changes;
    const GiOutput out = renderer_->render(
        {document.scene, seen, view, settings.method, settings.values, lightOnly, false, 0});
    picture_ = out.radiance;
    settled_ = out.settled;
  }
  if (shown_ == Shown::heat)
    makeHeat(*first.radiance);
  else
    heat_.reset();
  if (shown_ == Shown::heat && heat_) heatFirst_ = first.radiance;
}

void SplitView::makeHeat(RadianceImage& first) {
  if (!picture_ || picture_->width() != first.width() || picture_->height() != first.height()) {
    heat_.reset();
    return;
  }
  if (heat_ && heatFirst_.get() == &first && heatSecond_ == picture_ && heatFor_ == heatScale_)
    return;
  const int block = taken_ ? taken_->block : 1;
  const Image a = averageBlocks(first.pixels(), block);
  const Image b = taken_ ? taken_->mean() : picture_->pixels();
  heat_ = std::make_shared<const ViewPicture>(
      heatMapOf(a, b, heatScale_, first.width(), first.height(), first_.text, second_.text));
  heatSecond_ = picture_;
  heatFor_ = heatScale_;
}

Image8 SplitView::compose(const Image8& first, float exposureEv, ToneMapper mapper) const {
  if (!on_ || shown_ == Shown::first) return first;
  if (shown_ == Shown::heat && heat_) return heat_->image;
  if (!picture_ || picture_->width() != first.width || picture_->height() != first.height)
    return first;
  Image8 second = toneMap(picture_->pixels(), exposureEv, mapper);
  if (shown_ == Shown::second) return second;
  const int divider = static_cast<int>(std::lround(position_ * static_cast<float>(first.width)));
  Image8 both = first;
  for (int y = 0; y < both.height; ++y)
    if (divider < both.width)
      std::copy(second.at(divider, y), second.at(0, y) + size_t{4} * second.width,
                both.at(divider, y));
  return both;
}

}  // namespace lamplighter
