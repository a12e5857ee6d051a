// The stages of ManyLights once its lights are at rest: shares, antialiasing, corners, refinement.
#include <algorithm>

#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/pixel_jitter.h"
#include "renderer/methods/many_lights/shading_options.h"
#include "renderer/methods/many_lights/stages.h"

namespace lamplighter {
namespace {

// Rays per pixel for bias compensation; pixels share them.
constexpr uint32_t kCornerPaths = 1;

BiasCompensation::Options cornerOptions(const FrameInputs& in, const ManyLightsOptions& options) {
  const bool isBounced = options.directShare < 1.0f && in.part != LightPart::direct;
  return {isBounced ? options.bounces : 0,
          (options.directShare > 0.0f || options.bounces == 0) && in.part != LightPart::indirect,
          options.clampDistance,
          kCornerPaths,
          static_cast<uint32_t>(options.seed),
          0,
          in.lightOnly,
          options.speculars,
          options.leastRoughness};
}

}  // namespace

// A picture of a part of the light, or with transfer, is not divided into shares.
bool ManyLights::usesShares(const FrameInputs& in, const Options& options) const {
  return in.part == LightPart::all && !options.prt &&
         LightShares::fits(in.view, options.shareBytes());
}

// Whether nothing but the brightness of lights changed since the picture settled.
bool ManyLights::onlyMixes(const FrameInputs& in, const Options& options) const {
  return shares_.isDone() && usesShares(in, options) && in.view == view_ &&
         (in.changes.none() || in.changes.onlyGains()) && in.lightOnly == lightOnly_ &&
         options.lightSums() == options_.lightSums() && options.antialias == options_.antialias &&
         options.cornerLight == options_.cornerLight &&
         options.shareMemory == options_.shareMemory && part_ == LightPart::all &&
         lights_.pending() == 0 && lights_.coarse() == 0 && !lights_.changedBesideGains() &&
         paths_.isAtRest() && choiceIsCurrent_ && shares_.canMix(controls_);
}

void ManyLights::goOnWithShares(const FrameInputs& in, const Options& options, StageTimer& stages) {
  if (shares_.isDone()) return;
  const LightProxies::Groups groups = groupsOf(in, options.groupShare, lights_.slots());
  LightShares::Options wanted{options.shareBytes(),      options.antialias,
                              shadingOf(options, false), options.mergePasses,
                              options.cornerLight,       cornerOptions(in, options)};
  gbufferIsCurrent_ = false;
  const bool traces = shares_.tracesCorners();
  shares_.goOn({in, *kernels_, lights_.table(), controls_, visibility_.get(), groups, wanted});
  stages.end(traces ? kCornersStage : kSharesStage);
  if (shares_.isDone()) mixShares(in);
  stages.end(kSharesStage);
}

void ManyLights::mixShares(const FrameInputs& in) {
  mixed_ = shares_.mix(in.view, controls_);
  if (const Image without = shares_.takeWithoutCorners(); !without.empty())
    corners_.takeGains(without, mixed_->pixels());
}

void ManyLights::refineSettled(const FrameInputs& in, const Options& options, bool shadedNow,
                               StageTimer& stages, GiOutput& out, ManyLightsStats& stats) {
  const bool mayRefine = in.part == LightPart::all;
  if (out.settled && !shadedNow && mayRefine) refine(in, options, stages, out, stats);
  out.refined = out.settled && (options.refine == 0 || refinement_.done() || !mayRefine);
}

void ManyLights::refine(const FrameInputs& in, const Options& options, StageTimer& stages,
                        GiOutput& out, ManyLightsStats& stats) {
  if (options.refine == 0) return;
  gbufferIsCurrent_ = false;
  const MapSize size = mapRooms_.scale() > 1 ? MapSize::fine : MapSize::coarse;
  stats.refineUpdates =
      refinement_.goOn(in, *kernels_, options.refinement(), *out.radiance, lights_.live(),
                       lights_.slots(), size, in.services.budget().refineUpdates);
  if (refinement_.image()) out.radiance = refinement_.image();
  stats.vplsRefined = refinement_.vpls();
  stats.vplsToRefine = options.refine;
  stages.end(kRefinementStage);
}

std::shared_ptr<RadianceImage> ManyLights::fillCorners(
    const FrameInputs& in, const Options& options, const std::shared_ptr<RadianceImage>& picture,
    bool isSmooth, StageTimer& stages) {
  if (isSmooth && !corners_.isWhole(in.view)) {
    const auto reflecting =
        prt_ && in.part == LightPart::all ? prt_->reflecting() : std::vector<uint8_t>();
    BiasCompensation::Options corner = cornerOptions(in, options);
    corner.reflectsWithin = reflecting;
    corners_.goOn(in, lights_.table(), corner);
    if (corners_.isWhole(in.view)) whole_ = corners_.addTo(*picture);
    stages.end(kCornersStage);
  }
  return isSmooth && corners_.isWhole(in.view) ? whole_ : corners_.scale(picture);
}

void ManyLights::addSample(const FrameInputs& in, const Options& options, StageTimer& stages) {
  const auto picture = shade(in, options, pixelJitter(samples_, options.antialias), stages);
  const Image& sample = picture->pixels();
  if (samples_ == 0) sum_ = Image(sample.width, sample.height);
  for (size_t i = 0; i < sample.pixels.size(); ++i) sum_.pixels[i] += sample.pixels[i];
  if (++samples_ == options.antialias) {
    const float weight = 1.0f / static_cast<float>(samples_);
    for (vec3& p : sum_.pixels) p *= weight;
    mean_ = std::make_shared<HostImage>(std::move(sum_));
  }
  stages.end(kAntialiasingStage);
}

}  // namespace lamplighter
