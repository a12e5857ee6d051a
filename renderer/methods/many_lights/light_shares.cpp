#include "renderer/methods/many_lights/light_shares.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/bias_compensation/bias_compensation_filter.h"
#include "renderer/bias_compensation/near_lamps.h"
#include "renderer/light_maps/patch_lights.h"
#include "renderer/methods/many_lights/add_scaled.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {
namespace {

// Work per frame: lights × pixels summed, and pixels whose bias is compensated.
constexpr uint64_t kLightPixelsAFrame = uint64_t{1} << 24;
constexpr int kCompensatedPixelsPerFrame = 1 << 16;
constexpr int kLampPixelsAFrame =
    1 << 18;  // pixels per frame for which light near lamps is corrected

// Maximum number of shares, because each costs time and memory. With more lights the faint ones
// have one common share.
constexpr size_t kMostShares = 32;

// Largest relative difference between factors that count as equal.
constexpr float kMostOff = 1e-5f;

// Memory of a share while it is computed: the light of the pixels without jitter, and of the mean.
constexpr size_t kBytesAPixel = 2 * sizeof(vec3);

size_t pixelsOf(const View& view) {
  return static_cast<size_t>(view.width) * static_cast<size_t>(view.height);
}

NearLamps nearLampsOf(const LightShares::Inputs& in) {
  const BiasCompensation::Options& corner = in.options.corner;
  return {in.frame.scene, in.frame.services.rays(), in.emitters, in.lights, in.controls, corner};
}

}  // namespace

bool LightShares::fits(const View& view, size_t bytes) {
  return pixelsOf(view) * kBytesAPixel <= bytes;
}

void LightShares::restart(ManyLightsKernels& kernels) {
  if (phase_ == Phase::idle) return;
  ImagePool pool = std::move(pool_);
  *this = LightShares();
  pool_ = std::move(pool);
  kernels.dropShares({});
}

// Each control has its own share. If memory is limited, only the brightest do, and the others have
// a common one.
void LightShares::begin(const Inputs& in) {
  const size_t count = in.controls.size();
  controls_ = in.controls.controls;
  const size_t fitting =
      std::min(in.options.bytes / (pixelsOf(in.frame.view) * kBytesAPixel), kMostShares);
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  if (count > fitting)
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return in.controls.controls[a].flux > in.controls.controls[b].flux;
    });
  shares_.resize(std::min(count, fitting));
  for (Share& s : shares_) s.light = Image(in.frame.view.width, in.frame.view.height);
  shareOf_.assign(count, 0);
  mixedIn_.assign(count, vec3(1.0f));
  for (size_t i = 0; i < count; ++i) {
    const size_t share = std::min(i, shares_.size() - 1);
    shares_[share].controls.push_back(order[i]);
    shareOf_[order[i]] = static_cast<uint32_t>(share);
  }
  if (count > fitting) {
    for (const uint32_t control : shares_.back().controls)
      mixedIn_[control] = in.controls.controls[control].gain;
    lightsWithoutShare_ = static_cast<int>(shares_.back().controls.size());
  }
  pictures_ = std::max(in.options.antialias, 1);
  phase_ = in.kernels.traits().sharesNeedMiddle || pictures_ == 1 ? Phase::middle : Phase::shifted;
}

void LightShares::goOn(const Inputs& in) {
  if (phase_ == Phase::idle) begin(in);
  if (phase_ == Phase::compensation) {
    traceCompensation(in);
  } else if (phase_ != Phase::done) {
    sumNext(in);
  }
}

int LightShares::stepsLeft() const {
  if (phase_ == Phase::done) return 0;
  return pictures_ - picture_ + 1;
}

// Sums the next shares of a picture.
void LightShares::sumNext(const Inputs& in) {
  const bool isMiddle = phase_ == Phase::middle;
  const bool isShown = !isMiddle || pictures_ == 1;
  const vec2 jitter = isMiddle ? vec2(0.0f) : pixelJitter(picture_, pictures_);
  const float weight = 1.0f / static_cast<float>(pictures_);
  // Between two steps other stages may have rendered another G-buffer.
  in.frame.backend.renderGBuffer(in.frame.view, jitter);
  if (isShown && !hasEmission_) emission_.add(in.frame, in.controls, jitter, weight);
  hasEmission_ = isShown;
  const uint64_t before = in.kernels.lightCounts().lightPixels;
  while (next_ < shares_.size()) {
    const uint64_t done = in.kernels.lightCounts().lightPixels - before;
    if (4 * done >= 3 * kLightPixelsAFrame) return;
    shared::ShadingParams shading = in.options.shading;
    shading.block.z = static_cast<float>(kLightPixelsAFrame - done) /
                      static_cast<float>(shared::kLightPixelsUnit);
    LightSampleTable lights = in.lights;
    lights.sumAtReference([&](const LightSample& l) { return mixedIn_[in.controls.of(l.id)]; });
    lights.sumOnly([&](const LightSample& l) { return shareOf_[in.controls.of(l.id)] == next_; });
    std::vector<shared::Vpl> vpls = lights.summedInOrder();
    std::shared_ptr<RadianceImage> image;
    if (in.visibility != nullptr) {
      LightProxies proxies;
      proxies.update(lights, in.groups);
      std::vector<int> slots;
      for (const shared::Vpl& vpl : vpls) slots.push_back(vpl.slot);
      vpls.insert(vpls.end(), proxies.lights().begin(), proxies.lights().end());
      PatchLights patches(*in.visibility, nullptr, in.options.mergePasses, nullptr, &proxies);
      patches.sumOnly(std::move(slots));
      image = in.kernels.shareOf(next_, vpls, shading, &patches, in.frame.lightOnly);
    } else {
      image = in.kernels.shareOf(next_, vpls, shading, nullptr, in.frame.lightOnly);
    }
    if (image == nullptr) return;  // the next frame goes on
    if (isShown) addScaled(shares_[next_].light, image->pixels(), weight);
    ++next_;
  }
  if (isShown && in.options.isCompensated && !correctNearLamps(in, jitter, weight)) return;
  next_ = 0;
  lampRows_ = 0;
  hasEmission_ = false;
  picture_ += isShown ? 1 : 0;
  phase_ = picture_ < pictures_       ? Phase::shifted
           : in.options.isCompensated ? Phase::compensation
                                      : Phase::done;
  if (picture_ < pictures_) return;
  if (in.options.isCompensated) keepUncompensated(in);
  const auto weights = weightsFor(in.controls);
  in.kernels.dropShares(weights ? weights->ofShares : std::vector<vec3>());
}

// Continues with the rows of the picture in progress. Returns whether they are complete.
bool LightShares::correctNearLamps(const Inputs& in, vec2 jitter, float weight) {
  const View& view = in.frame.view;
  const NearLamps lamps = nearLampsOf(in);
  if (lamps.empty() || lampRows_ == view.height) return true;
  if (nearLamps_.empty()) nearLamps_ = Image(view.width, view.height);
  const int end = std::min(view.height, lampRows_ + std::max(1, kLampPixelsAFrame / view.width));
  std::vector<std::vector<BiasCompensation::Contribution>> byRow(static_cast<size_t>(view.height));
  lamps.findRows(view, jitter, static_cast<uint32_t>(picture_), lampRows_, end, byRow);
  const std::vector<vec3> gains = weightsFor(in.controls)->ofControls;
  tbb::parallel_for(lampRows_, end, [&](int y) {
    for (const BiasCompensation::Contribution& c : byRow[static_cast<size_t>(y)]) {
      const vec3 light = weight * c.light;
      shares_[shareOf_[c.group]].light.pixels[c.pixel] += mixedIn_[c.group] * light;
      nearLamps_.pixels[c.pixel] += gains[c.group] * light;
    }
  });
  lampRows_ = end;
  return lampRows_ == view.height;
}

void LightShares::keepUncompensated(const Inputs& in) {
  uncompensated_ = Image(in.frame.view.width, in.frame.view.height);
  mixTo(*weightsFor(in.controls), uncompensated_);
  if (nearLamps_.empty()) return;
  for (size_t i = 0; i < nearLamps_.pixels.size(); ++i)
    uncompensated_.pixels[i] -= nearLamps_.pixels[i];
  nearLamps_ = {};
  // Where shadow maps and rays disagree, more light may be subtracted than there was.
  for (Share& s : shares_)
    for (vec3& p : s.light.pixels) p = glm::max(p, vec3(0.0f));
}

void LightShares::traceCompensation(const Inputs& in) {
  const View& view = in.frame.view;
  if (rows_ == view.height) return addCompensation(in);
  std::vector<SceneVpl> vpls;
  std::vector<uint32_t> groups;
  for (const LightSample& sample : in.lights.samples) {
    if (!sample.isLive) continue;
    vpls.push_back(sample);
    vpls.back().vpl.intensity = in.lights.reference[static_cast<size_t>(sample.vpl.slot)];
    groups.push_back(in.controls.of(sample.id));
  }
  std::vector<BiasCompensation::Emission> emissions;
  for (const int control : in.controls.ofObject) {
    if (control == kNone)
      emissions.emplace_back();
    else
      emissions.push_back({static_cast<uint32_t>(control),
                           in.controls.controls[static_cast<size_t>(control)].reference});
  }
  const NearLamps lamps = nearLampsOf(in);
  BiasCompensation::Options options = in.options.corner;
  options.groups = groups;
  options.emissions = emissions;
  options.exactLamps = lamps.exactLamps();
  const BiasCompensation compensation(in.frame.scene, in.frame.services.rays(), vpls, options);
  pixels_.resize(pixelsOf(view));
  contributions_.resize(static_cast<size_t>(view.height));
  const int end =
      std::min(view.height, rows_ + std::max(1, kCompensatedPixelsPerFrame / view.width));
  compensation.findRows(view, vec2(0.0f), rows_, end, pixels_, contributions_);
  rows_ = end;
}

// One share in each call, because smoothing takes long in large pictures.
void LightShares::addCompensation(const Inputs& in) {
  const int width = in.frame.view.width, height = in.frame.view.height;
  if (compensated_ < shares_.size()) {
    tbb::parallel_for(0, height, [&](int y) {
      const size_t row = static_cast<size_t>(y) * static_cast<size_t>(width);
      for (int x = 0; x < width; ++x) pixels_[row + static_cast<size_t>(x)].light = vec3(0.0f);
      for (const BiasCompensation::Contribution& c : contributions_[static_cast<size_t>(y)])
        if (shareOf_[c.group] == compensated_)
          pixels_[c.pixel].light += mixedIn_[c.group] * c.light;
    });
    addSmoothed(pixels_, filterRadius(1, height), shares_[compensated_].light);
    ++compensated_;
  }
  if (compensated_ < shares_.size()) return;
  pixels_ = {};
  contributions_ = {};
  phase_ = Phase::done;
}

std::optional<LightShares::Weights> LightShares::weightsFor(const LightControls& controls) const {
  Weights weights;
  weights.ofControls.assign(controls_.size(), vec3(0.0f));
  std::vector<bool> isKnown(controls.size(), false);
  for (size_t i = 0; i < controls_.size(); ++i) {
    // Most controls keep their place.
    size_t now = i;
    if (i >= controls.size() || !(controls.controls[i].key == controls_[i].key))
      now = static_cast<size_t>(
          std::ranges::find(controls.controls, controls_[i].key, &LightControls::Control::key) -
          controls.controls.begin());
    if (now == controls.size()) {  // it is black now
      weights.isFinal = false;
      continue;
    }
    isKnown[now] = true;
    const LightControls::Control& c = controls.controls[now];
    const bool isSame = c.reference == controls_[i].reference;
    weights.ofControls[i] = isSame ? c.gain : c.gain * (c.reference / controls_[i].reference);
    weights.isFinal = weights.isFinal && isSame;
  }
  for (size_t i = 0; i < controls.size(); ++i)
    if (!isKnown[i] && controls.controls[i].gain != vec3(0.0f)) return std::nullopt;
  for (const Share& s : shares_) weights.ofShares.push_back(weights.ofControls[s.controls.front()]);
  if (lightsWithoutShare_ == 0) return weights;
  // All lights in one share must have changed by the same factor in each channel.
  for (int c = 0; c < 3; ++c) {
    std::optional<float> ratio;
    for (const uint32_t control : shares_.back().controls) {
      const float before = mixedIn_[control][c], now = weights.ofControls[control][c];
      if (before == 0.0f && now == 0.0f) continue;
      const float change = now / before;
      if (!ratio) ratio = change;
      if (!(std::abs(change - *ratio) <= kMostOff * *ratio)) return std::nullopt;
    }
    weights.ofShares.back()[c] = ratio.value_or(1.0f);
  }
  weights.isFinal = weights.isFinal && weights.ofShares.back() == vec3(1.0f);
  return weights;
}

void LightShares::mixTo(const Weights& weights, Image& picture) const {
  tbb::parallel_for(0, picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      vec3 sum(0.0f);
      for (size_t i = 0; i < shares_.size(); ++i)
        sum += weights.ofShares[i] * shares_[i].light.at(x, y);
      picture.at(x, y) = sum;
    }
  });
  emission_.addTo(picture, weights.ofControls);
}

std::shared_ptr<RadianceImage> LightShares::mix(const View& view, const Weights& weights) {
  const auto picture = pool_.take(view.width, view.height);
  mixTo(weights, picture->image);
  return picture;
}

size_t LightShares::bytes() const {
  size_t bytes = uncompensated_.pixels.size() * sizeof(vec3);
  for (const Share& s : shares_) bytes += s.light.pixels.size() * sizeof(vec3);
  return bytes;
}

}  // namespace lamplighter
