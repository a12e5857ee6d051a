#include "renderer/methods/many_lights/live_bias_compensation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/bias_compensation/bias_compensation_filter.h"
#include "renderer/bias_compensation/near_lamps.h"

namespace lamplighter {
namespace {

constexpr int kPixelsAFrame = 1 << 15;
// The pixels that may show a box: from `low` to before `high`.
struct PixelRect {
  glm::ivec2 low, high;
};

PixelRect pixelsOf(const View& view, const Bounds& box) {
  const glm::ivec2 all(view.width, view.height);
  vec2 low(INFINITY), high(-INFINITY);
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 at(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                  corner & 4 ? box.max.z : box.min.z);
    const vec3 seen = view.project(at);
    if (!(seen.z > 0.0f)) return {glm::ivec2(0), all};  // the box reaches behind the eye
    low = glm::min(low, vec2(seen));
    high = glm::max(high, vec2(seen));
  }
  const vec2 limit(all);
  const glm::ivec2 first = glm::floor(glm::clamp(low - 1.0f, vec2(0.0f), limit)),
                   last = glm::ceil(glm::clamp(high + 1.0f, vec2(0.0f), limit));
  return {glm::min(first, last), last};
}

// Limits of the gain: where there was almost no light the ratio has no meaning.
constexpr float kMostGain = 2.0f, kLeastGain = 0.5f;

}  // namespace

void LiveBiasCompensation::goOn(const FrameInputs& in, const LightSet& emitters,
                                const LightSampleTable& lights, const LightControls& controls,
                                BiasCompensation::Options options) {
  const View& view = in.view;
  const NearLamps lamps(in.scene, in.services.rays(), emitters, lights, controls, options);
  options.exactLamps = lamps.exactLamps();
  const std::vector<SceneVpl> vpls = liveSamples(lights.samples);
  const BiasCompensation biasCompensation(in.scene, in.services.rays(), vpls, options);
  pixels_.resize(static_cast<size_t>(view.width) * static_cast<size_t>(view.height));
  const int end = std::min(view.height, rows_ + std::max(1, kPixelsAFrame / view.width));
  biasCompensation.findRows(view, vec2(0.0f), rows_, end, pixels_);
  if (rows_ == 0) nearLamps_ = Image(view.width, view.height);
  std::vector<std::vector<BiasCompensation::Contribution>> byRow(static_cast<size_t>(view.height));
  if (!lamps.empty()) lamps.findRows(view, vec2(0.0f), 0, rows_, end, byRow);
  for (int y = rows_; y < end; ++y)
    for (const BiasCompensation::Contribution& c : byRow[static_cast<size_t>(y)])
      nearLamps_.pixels[c.pixel] += controls.controls[c.group].gain * c.light;
  rows_ = end;
}

std::shared_ptr<RadianceImage> LiveBiasCompensation::addTo(RadianceImage& settled) {
  const Image& without = settled.pixels();
  Image with = without;
  addSmoothed(pixels_, filterRadius(1, with.height), with);
  for (size_t i = 0; i < with.pixels.size(); ++i)
    with.pixels[i] = glm::max(with.pixels[i] + nearLamps_.pixels[i], vec3(0.0f));
  pixels_ = {};
  nearLamps_ = {};
  takeGains(without, with);
  return std::make_shared<HostImage>(std::move(with));
}

void LiveBiasCompensation::takeGains(const Image& without, const Image& with) {
  Image gains(with.width, with.height);
  tbb::parallel_for(0, with.height, [&](int y) {
    for (int x = 0; x < with.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float before = without.at(x, y)[c], after = with.at(x, y)[c];
        const float gain = after < kMostGain * before ? after / before : kMostGain;
        gains.at(x, y)[c] = after == before ? 1.0f : std::max(gain, kLeastGain);
      }
    }
  });
  gains_ = std::make_shared<const Image>(std::move(gains));
}

void LiveBiasCompensation::dropGains(const View& view, std::span<const MoverFinder::Mover> movers) {
  if (!gains_ || movers.empty()) return;
  if (gains_->width != view.width || gains_->height != view.height) return;
  Image kept = *gains_;
  for (const MoverFinder::Mover& mover : movers)
    for (const Bounds& place : {mover.before, mover.after}) {
      if (place.empty()) continue;
      const PixelRect r = pixelsOf(view, place);
      for (int y = r.low.y; y < r.high.y; ++y)
        std::fill_n(kept.pixels.begin() + y * kept.width + r.low.x, r.high.x - r.low.x, vec3(1.0f));
    }
  gains_ = std::make_shared<const Image>(std::move(kept));
}

std::shared_ptr<RadianceImage> LiveBiasCompensation::scale(
    Backend& backend, const std::shared_ptr<RadianceImage>& picture) const {
  const bool fits =
      gains_ && gains_->width == picture->width() && gains_->height == picture->height();
  return fits ? backend.multiplied(picture, gains_) : picture;
}

}  // namespace lamplighter
