#include "editor/split/split_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "editor/notices/failure_text.h"
#include "editor/split/heat_map.h"
#include "renderer/image/average_blocks.h"
#include "renderer/methods/path_tracer/reference_method.h"

namespace lamplighter {

void SplitView::turnOn(SplitSide first, std::vector<SplitSide> others) {
  turnOff();
  first_ = std::move(first);
  for (SplitSide& side : others) others_.emplace_back(std::move(side));
  on_ = true;
  shown_ = Shown::both;
}

void SplitView::turnOff() {
  on_ = settled_ = refined_ = false;
  others_.clear();  // frees their shadow maps and copies of the scene
  next_ = 0;
  firstPicture_.reset();
  firstProgress_ = {};
  errors_ = {};
  taken_.reset();
  heat_.reset();
  heatFirst_.reset();
  heatSecond_.reset();
}

const SplitSide& SplitView::second() const {
  return others_.empty() ? first_ : others_.front().side();
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

void SplitView::frame(const Frame& frame) {
  if (!on_) return;
  for (ComparedSide& side : others_) side.note(frame.changes, frame.side);
  SideInput seen = frame.side.of(first_);
  const bool isNew = !frame.changes.none() || !(seen == firstSeen_);
  firstSeen_ = std::move(seen);
  firstProgress_.frame(isNew, frame.seconds, frame.first.settled);
  firstPicture_ = frame.first.radiance;
  liveMethod_ = frame.side.document.render.method;
  if (shown_ == Shown::tiles)
    renderTile(frame);
  else
    renderSecond(frame);
  if (shown_ == Shown::heat)
    makeHeat();
  else
    heat_.reset();
}

void SplitView::renderSecond(const Frame& frame) {
  ComparedSide& second = others_.front();
  const SideInput wanted = frame.side.of(second.side());
  const ErrorMeter& meter = frame.meter;
  if (meter.on() && wanted.settings.method == kReferenceMethod &&
      second.side().values.values().empty()) {
    std::shared_ptr<RadianceImage> picture;
    if (meter.reference() && meter.reference() != taken_) {
      taken_ = meter.reference();
      const View& view = frame.side.view;
      picture = std::make_shared<HostImage>(enlarged(taken_->mean(), view.width, view.height));
    }
    second.show(std::move(picture), meter.reference() != nullptr);
  } else {
    taken_.reset();
    second.render(frame.side, make_);
  }
  settled_ = second.settled();
  refined_ = second.refined() || !frame.side.isPaced;
}

void SplitView::renderTile(const Frame& frame) {
  taken_.reset();
  for (size_t i = 0; i < others_.size(); ++i) {
    ComparedSide& side = others_[next_];
    next_ = (next_ + 1) % others_.size();
    if (side.isDone(frame.side)) continue;
    try {
      side.render(frame.side, make_);
    } catch (const std::exception& e) {
      side.fail(failureText(e), frame.side);
    }
    break;
  }
  const auto isDone = [&](const ComparedSide& side) { return side.isDone(frame.side); };
  refined_ = std::ranges::all_of(others_, isDone);
  settled_ = refined_ || std::ranges::all_of(others_, &ComparedSide::settled);
  compare(false);
}

size_t SplitView::baseSide() const {
  const auto isReference = [&](const ComparedSide& s) {
    return s.side().method == kReferenceMethod;
  };
  const auto found = std::ranges::find_if(others_, isReference);
  if (found != others_.end()) return 1 + static_cast<size_t>(found - others_.begin());
  return firstSeen_.settings.method == kReferenceMethod ? 0 : others_.size();
}

void SplitView::compare(bool waits) {
  std::vector<TileErrors::Picture> pictures;
  for (size_t i = 0; i < sides(); ++i) pictures.push_back(picture(i));
  errors_.update(pictures, baseSide(), waits);
}

std::shared_ptr<RadianceImage> SplitView::picture(size_t side) const {
  if (side >= sides()) return nullptr;
  return side == 0 ? firstPicture_ : others_[side - 1].picture();
}

std::string SplitView::title(size_t side) const {
  const SplitSide& shown = side == 0 ? first_ : others_[side - 1].side();
  return shown.method.empty() && !liveMethod_.empty() ? shown.text + ": " + liveMethod_
                                                      : shown.text;
}

std::vector<std::string> SplitView::figures(size_t side) const {
  if (side > 0 && !others_[side - 1].failure().empty()) return {others_[side - 1].failure()};
  const SideProgress& progress = side == 0 ? firstProgress_ : others_[side - 1].progress();
  std::vector<std::string> lines{progress.text()};
  if (const std::optional<double> error = errors_.of(side))
    lines.push_back(fmt::format("{:.1f}% from {}", 100.0 * *error, title(baseSide())));
  return lines;
}

void SplitView::makeHeat() {
  const std::shared_ptr<RadianceImage> second = secondPicture();
  RadianceImage& first = *firstPicture_;
  if (!second || second->width() != first.width() || second->height() != first.height()) {
    heat_.reset();
    return;
  }
  if (heat_ && heatFirst_ == firstPicture_ && heatSecond_ == second && heatFor_ == heatScale_)
    return;
  const int block = taken_ ? taken_->block : 1;
  const Image a = averageBlocks(first.pixels(), block);
  const Image b = taken_ ? taken_->mean() : second->pixels();
  heat_ = std::make_shared<const ViewPicture>(
      heatMapOf(a, b, heatScale_, first.width(), first.height(), first_.text, this->second().text));
  heatFirst_ = firstPicture_;
  heatSecond_ = second;
  heatFor_ = heatScale_;
}

std::vector<Tile> SplitView::tiles(const Image8& first, float exposureEv, ToneMapper mapper) const {
  std::vector<Tile> result;
  for (size_t i = 0; i < sides(); ++i) {
    const std::shared_ptr<RadianceImage> own = picture(i);
    const bool fits = own && own->width() == first.width && own->height() == first.height;
    Image8 shown = i == 0 ? first
                   : fits ? toneMap(own->pixels(), exposureEv, mapper)
                          : Image8(first.width, first.height);
    result.push_back({std::move(shown), title(i), figures(i)});
  }
  return result;
}

Image8 SplitView::sheet(const Image8& first, int columns, float exposureEv, ToneMapper mapper) {
  compare(true);
  const Font font(look::kTextFont, static_cast<int>(look::kFontSize), "the split view");
  return tileSheet(tiles(first, exposureEv, mapper), columns, font);
}

Image8 SplitView::compose(const Image8& first, float exposureEv, ToneMapper mapper) const {
  if (!on_ || shown_ == Shown::first) return first;
  if (shown_ == Shown::heat && heat_) return heat_->image;
  const std::shared_ptr<RadianceImage> own = secondPicture();
  if (!own || own->width() != first.width || own->height() != first.height) return first;
  Image8 second = toneMap(own->pixels(), exposureEv, mapper);
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
