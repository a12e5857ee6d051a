// The stages of ManyLights once its lights are at rest: shares, antialiasing, bias compensation,
// refinement.
#include <algorithm>

#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/many_lights/shading_options.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {
namespace {

// Rays per pixel for bias compensation; pixels share them.
constexpr uint32_t kCompensationPaths = 1;

BiasCompensation::Options compensationOptions(const FrameInputs& in,
                                              const ManyLightsOptions& options) {
  const bool isBounced = options.directShare < 1.0f && in.part != LightPart::direct;
  return {isBounced ? options.bounces : 0,
          (options.directShare > 0.0f || options.bounces == 0) && in.part != LightPart::indirect,
          options.clampDistance,
          kCompensationPaths,
          static_cast<uint32_t>(options.seed),
          0,
          in.lightOnly,
          options.speculars,
          options.leastRoughness};
}

// Share of the usual work of a frame on light on surfaces.
float paceOf(const FrameInputs& in, const ManyLightsOptions& options) {
  return surfacePace(in.services.budget().surfaceWork, options.updates);
}

}  // namespace

// A picture of a part of the light, or with transfer, is not divided into shares.
bool ManyLights::usesShares(const FrameInputs& in, const Options& options) const {
  return in.part == LightPart::all && !options.prt &&
         LightShares::fits(in.view, options.shareBytes());
}

// Whether the picture differs from the last one in no more than the brightness of lights.
bool ManyLights::isSamePicture(const FrameInputs& in, const Options& options) const {
  const int slots = lights_.slots() + Refinement::slots(options.refinement());
  if (slots != mapSlots_ || options.mapRooms(slots) != mapRooms_) return false;
  return started_ && usesShares(in, options) && in.view == view_ &&
         (in.changes.none() || in.changes.onlyBrightness()) && in.lightOnly == lightOnly_ &&
         part_ == LightPart::all && options.lightSums() == options_.lightSums() &&
         options.counts() == options_.counts() && options.antialias == options_.antialias &&
         options.biasCompensation == options_.biasCompensation &&
         options.shareMemory == options_.shareMemory;
}

// Whether the light samples and their maps are in their wanted state.
bool ManyLights::isAtRest() const {
  const bool isFine = mapRooms_.scale() == 1 || lights_.coarse() == 0;
  return lights_.pending() == 0 && isFine && paths_.isAtRest() && choiceIsCurrent_ &&
         lampsAreCurrent_;
}

// Shows the shares of a settled picture with the current brightness of lights, and does nothing
// else. If light samples must be distributed to the lights again, the next frames do it while they
// show the mix.
bool ManyLights::mixOnly(const FrameInputs& in, const Options& options, GiOutput& out,
                         ManyLightsStats& stats) {
  if (!shares_.isDone() || !isSamePicture(in, options)) return false;
  if (!in.changes.none()) {
    const LightControls controls(in.scene, LightSet(in.scene, paths_.lights()));
    const auto weights = shares_.weightsFor(controls);
    holdsMix_ = false;
    if (!weights) return false;
    mixShares(in, *weights);
    imageIsStale_ = true;
    refinement_.restart();
    holdsMix_ = !weights->isFinal || sharesAreOld_ || !isAtRest();
    sharesAreOld_ = sharesAreOld_ || holdsMix_;
    if (!holdsMix_ && unsampled_.onlyGains()) {
      updateLights(in, options, stats);  // only their brightness
      lights_.clearChanged();
    }
  } else if (holdsMix_ || !isAtRest()) {
    return false;
  }
  out.settled = !holdsMix_;
  out.radiance = mixed_;
  return true;
}

void ManyLights::restartShares() {
  shares_.restart(*kernels_);
  sharesAreOld_ = false;
}

void ManyLights::goOnWithShares(const FrameInputs& in, const Options& options, StageTimer& stages) {
  if (sharesAreOld_) restartShares();
  if (shares_.isDone()) return;
  const LightProxies::Groups groups = groupsOf(in, options.groupShare, lights_.slots());
  LightShares::Options wanted{options.shareBytes(),      options.antialias,
                              shadingOf(options, false), options.mergePasses,
                              options.biasCompensation,  compensationOptions(in, options)};
  gbufferIsCurrent_ = false;
  const bool traces = shares_.compensatesBias();
  shares_.goOn({in, *kernels_, paths_.lights(), lights_.table(), controls_, visibility_.get(),
                groups, wanted});
  stages.end(traces ? kBiasCompensationStage : kSharesStage);
  if (shares_.isDone()) {
    mixShares(in, *shares_.weightsFor(controls_));
    holdsMix_ = false;
  }
  stages.end(kSharesStage);
}

void ManyLights::mixShares(const FrameInputs& in, const LightShares::Weights& weights) {
  mixed_ = shares_.mix(in.view, weights);
  if (const Image without = shares_.takeUncompensated(); !without.empty())
    compensation_.takeGains(without, mixed_->pixels());
}

void ManyLights::refineSettled(const FrameInputs& in, const Options& options, bool shadedNow,
                               StageTimer& stages, GiOutput& out, ManyLightsStats& stats) {
  const bool mayRefine = in.part == LightPart::all;
  // The picture is settled when light on surfaces is, too.
  const bool waits =
      (options.useMeshes() && (!meshes_.isDone(options.antialias) || !in.changes.none())) ||
      (options.useLinks() && (!linked_.isDone(options.antialias) || !in.changes.none())) ||
      (options.useField() && (!field_.isDone(options.antialias) || !in.changes.none())) ||
      (options.useImperfect() && (!imperfect_.isDone() || !in.changes.none()));
  if (out.settled && !shadedNow && mayRefine && !waits) refine(in, options, stages, out, stats);
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

std::shared_ptr<RadianceImage> ManyLights::compensateBias(
    const FrameInputs& in, const Options& options, const std::shared_ptr<RadianceImage>& picture,
    bool isSmooth, StageTimer& stages) {
  if (isSmooth && !compensation_.isWhole(in.view)) {
    const auto reflecting =
        prt_ && in.part == LightPart::all ? prt_->reflecting() : std::vector<uint8_t>();
    BiasCompensation::Options corner = compensationOptions(in, options);
    corner.reflectsWithin = reflecting;
    compensation_.goOn(in, paths_.lights(), lights_.table(), controls_, corner);
    if (compensation_.isWhole(in.view)) whole_ = compensation_.addTo(*picture);
    stages.end(kBiasCompensationStage);
  }
  return isSmooth && compensation_.isWhole(in.view) ? whole_
                                                    : compensation_.scale(in.backend, picture);
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

// Adds bounced light that is stored on surfaces.
void ManyLights::addMeshes(const FrameInputs& in, const Options& options, StageTimer& stages,
                           GiOutput& out, ManyLightsStats& stats) {
  if (!options.useMeshes()) return meshes_.forget();
  meshes_.outdate(in.changes);
  const auto& emitters = paths_.lights().emitters();
  const bool showsSky =
      in.part != LightPart::indirect && std::ranges::any_of(emitters, [](const Emitter& e) {
        return e.kind == EmitterKind::sky && e.skySun == 0;
      });
  const bool showsBounces = in.part != LightPart::direct && options.meshBounces > 0;
  if (!showsSky && !showsBounces) return;
  SurfaceLightOptions light = options.surfaceLight(options.meshBounces, options.seed);
  light.part = showsSky && showsBounces ? SurfaceLightPart::both
               : showsSky               ? SurfaceLightPart::sky
                                        : SurfaceLightPart::bounced;
  meshes_.update(in, light, {in.lightOnly, options.speculars, options.leastRoughness},
                 paceOf(in, options));
  const int samples = (out.settled || holdsMix_) && options.antialias > 1 ? options.antialias : 1;
  out.radiance = meshes_.addTo(in, out.radiance, samples, gbufferIsCurrent_);
  if (!meshes_.isDone(options.antialias)) refinement_.restart();
  out.settled = out.settled && meshes_.isDone(options.antialias);
  if (out.settled) out.surfaces = meshes_.surfaces(in);
  out.refined = out.refined && out.settled;
  if (!out.settled)
    stats.framesUntilSettled =
        std::max({1, stats.framesUntilSettled, meshes_.framesLeft(options.antialias)});
  stats.take(meshes_.counts());
  if (meshes_.counts().rays > 0) stats.surfaceWork = meshes_.pace();
  stats.raysTraced += meshes_.counts().rays;
  stages.end(kMeshesStage);
}

// Adds bounced light along links of texels.
void ManyLights::addLinks(const FrameInputs& in, const Options& options, StageTimer& stages,
                          GiOutput& out, ManyLightsStats& stats) {
  if (!options.useLinks()) linked_.forget();
  linked_.outdate(in);
  if (!options.useLinks() || in.part == LightPart::direct) return;
  linked_.update(in, options.radiosity(options.linkBounces, options.seed), paceOf(in, options));
  const int samples = (out.settled || holdsMix_) && options.antialias > 1 ? options.antialias : 1;
  out.radiance = linked_.addTo(in, out.radiance, samples,
                               {in.lightOnly, options.speculars, options.leastRoughness},
                               static_cast<uint32_t>(options.seed), gbufferIsCurrent_);
  const bool isDone = linked_.isDone(options.antialias);
  if (!isDone) refinement_.restart();
  out.settled = out.settled && isDone;
  if (out.settled) out.surfaces = linked_.surfaces(in);
  out.refined = out.refined && out.settled;
  if (!out.settled)
    stats.framesUntilSettled =
        std::max({1, stats.framesUntilSettled, linked_.framesLeft(options.antialias)});
  stats.take(linked_.light());
  stats.raysTraced += linked_.light().counts().rays;
  if (linked_.light().counts().rays > 0) stats.surfaceWork = paceOf(in, options);
  stages.end(kMeshesStage);
}

// Adds bounced light and the light of the sky from a light field.
void ManyLights::addField(const FrameInputs& in, const Options& options, StageTimer& stages,
                          GiOutput& out, ManyLightsStats& stats) {
  if (!options.useField()) field_.forget();
  field_.outdate(in);
  if (!options.useField()) return;
  LightFieldOptions light = options.field(options.fieldBounces, options.seed);
  light.showsSky = in.part != LightPart::indirect;
  light.showsBounces = light.showsBounces && in.part != LightPart::direct;
  field_.update(in, light, paceOf(in, options));
  const int samples = (out.settled || holdsMix_) && options.antialias > 1 ? options.antialias : 1;
  out.radiance = field_.addTo(in, out.radiance, samples,
                              {in.lightOnly, options.speculars, options.leastRoughness},
                              static_cast<uint32_t>(options.seed), gbufferIsCurrent_);
  const bool isDone = field_.isDone(options.antialias);
  if (!isDone) refinement_.restart();
  out.settled = out.settled && isDone;
  if (out.settled) out.surfaces = field_.surfaces(in);
  out.refined = out.refined && out.settled;
  if (!out.settled)
    stats.framesUntilSettled =
        std::max({1, stats.framesUntilSettled, field_.framesLeft(options.antialias)});
  stats.take(field_.light());
  stats.raysTraced += stats.fieldRays;
  if (stats.fieldRays > 0) stats.surfaceWork = paceOf(in, options);
  stages.end(kMeshesStage);
}

void ManyLights::addImperfect(const FrameInputs& in, const Options& options, StageTimer& stages,
                              GiOutput& out, ManyLightsStats& stats) {
  if (!options.useImperfect()) {
    imperfect_.forget();
    return;
  }
  const EndStage noStage = [](const StageSpec&) {};
  imperfect_.update(in, options.imperfect(), noStage);
  if (in.part == LightPart::direct) return;
  ImperfectPicture::Direct direct{out.radiance, out.settled, {}, &gbufferIsCurrent_};
  if (out.settled) direct.lights = liveSamples(lights_.table().samples);
  out.radiance =
      imperfect_.addTo(in, direct, options.antialias,
                       {in.lightOnly, options.speculars, options.leastRoughness}, noStage);
  if (!imperfect_.isDone()) refinement_.restart();
  out.settled = out.settled && imperfect_.isDone();
  out.refined = out.refined && out.settled;
  if (!out.settled)
    stats.framesUntilSettled = std::max({1, stats.framesUntilSettled, imperfect_.framesLeft()});
  stats.raysTraced += imperfect_.raysTraced();
  stages.end(kMeshesStage);
}

}  // namespace lamplighter
