#include "renderer/methods/many_lights/many_lights.h"

#include <algorithm>
#include <utility>

#include "renderer/light_maps/patch_lights.h"
#include "renderer/methods/many_lights/inspected_surfaces.h"
#include "renderer/methods/many_lights/shading_options.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/sampling/choice/view_importance.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/sun_shadow_tiles.h"
#include "renderer/sampling/vpl_footprints.h"
#include "renderer/scene/surface.h"
#include "renderer/visibility/shadow_map_demand.h"

namespace lamplighter {
namespace {

bool hasGlossy(const RenderScene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const RenderObject& o) {
    return mayBeGlossy(scene.materials[static_cast<size_t>(o.material)]);
  });
}

// Maps per frame, for maps `scale` times finer than coarse ones. With traced maps (cpu), texels
// dominate the time: fine maps take 12 to 14 times as long at a scale of six. A third as many maps
// makes the frame about twice as long as a frame of a drag, which does other work too; with still
// fewer, the fixed work of a frame would dominate. With rasterised maps (gl), each frame sums all
// lights again, so fewer frames are better.
int mapsAFrame(const ManyLightsTraits& traits, const ManyLightsOptions& options, int scale) {
  const RefreshWork most = options.budget().work;
  uint64_t maps = std::min<uint64_t>(most.shadowMaps, static_cast<uint64_t>(options.updates));
  if (traits.tracesShadowMaps) {
    const auto side = static_cast<uint64_t>(scale * options.mapResolution);
    maps = std::min(scale == 1 ? maps : 2 * maps / static_cast<uint64_t>(scale),
                    most.rays / side / side);
  }
  return static_cast<int>(std::max<uint64_t>(maps, 1));
}

// Limits of a frame for summing light at edges, in units of kLightPixelsUnit. A frame that needs
// more interpolates the other edges, and the next ones go on. The limit is lower while the camera
// moves, because each frame sums all lights then.
constexpr float kMostAtEdges = 512.0f, kMostMoving = 256.0f;

// Fine maps of punctual hard-shadow lights per frame: those of a lamp, which has two hemispheres.
constexpr int kHardMapsAFrame = 2;

}  // namespace

GiOutput ManyLights::render(const FrameInputs& in) {
  ManyLightsStats stats;
  waitsBefore_ = in.backend.counts().waits;
  uploadsBefore_ = kernels_->lightCounts().bytesUploaded;
  StageTimer stages(in, kManyLightsStages, stats);
  Options options(in.settings, in.services.budget().refineUpdates > 0,
                  kernels_->traits().tracesShadowMaps, in.scene);
  options.withoutSurfaces = withoutSurfaces_ || (options.useField() && options.fieldLamps);
  GiOutput out = renderSamples(in, options, stages, stats);
  addMeshes(in, options, stages, out, stats);
  addLinks(in, options, stages, out, stats);
  addField(in, options, stages, out, stats);
  addImperfect(in, options, stages, out, stats);
  if (!options.carrierReason.empty()) stats.chosen["indirect"] = options.carrierReason;
  out.stats = published(stats, manyLightsStatistics());
  return out;
}

// Everything but the light on surfaces.
GiOutput ManyLights::renderSamples(const FrameInputs& in, Options& options, StageTimer& stages,
                                   ManyLightsStats& stats) {
  GiOutput out;
  const bool wantsVisibility = options.useVisibility();
  if (in.changes.rebuilt || in.changes.objects || lights_.slots() != neededFor_)
    visibilityNeeds_ = 0;
  if (visibilityNeeds_ > options.visibilityBytes()) options.forgoVisibility();

  // 1. If only the brightness of lights changed, show the shares of a settled picture with new
  // weights.
  takeScene(in, options);
  unsampled_.merge(in.changes);
  if (!in.changes.none()) gbufferIsCurrent_ = false;
  if (!isSamePicture(in, options)) holdsMix_ = false;
  if (mixOnly(in, options, out, stats)) {
    stages.end(kSharesStage);
    if (options.antialias > 1) out.smoothEdges = smoothEdges();
    if (options.refinement() != options_.refinement()) refinement_.restart();
    options_ = options;
    refineSettled(in, options, false, stages, out, stats);
    count(in, options, out, stats);
    return out;
  }

  // 2. Find which VPLs the scene requires, and which shown ones are out of date.
  updateLights(in, options, stats);
  stages.end(kLightSamplesStage);

  // 3. Refresh some of them completely: position, intensity, where their maps are needed,
  stats.updates = refreshLights(options);
  updateVisibility(in, options, stats);
  stages.end(kVisibilityStage);

  // 4. their maps, if the view needs them, and their unshadowed light.
  updateMaps(in, options, stats);
  stages.end(kShadowMapsStage);
  sharpenMaps(options, stats);
  stages.end(kFinerMapsStage);
  updateLightMaps(in, options, stats);
  stages.end(kLightMapsStage);
  const bool prtChanged = updatePrt(in, options, stats);
  if (prt_) out.failure = prt_->takeError();
  if (visibility_) visibility_->clearChanged();
  stages.end(kTransferStage);

  // 5. Render the picture, if anything in it changed.
  const bool viewChanged = !in.changes.none() || view_ != in.view;
  const bool shadingChanged = options.lightSums() != options_.lightSums() ||
                              stats.lightMapTexel != lightMapTexel_ || in.lightOnly != lightOnly_ ||
                              in.part != part_;
  if (viewChanged) gbufferIsCurrent_ = false;
  if (view_ != in.view || shadingChanged || options.biasCompensation != options_.biasCompensation)
    compensation_.forget();
  if (in.changes.surfaces()) compensation_.dropGains(in.view, in.services.movers());
  const bool isReady = isAtRest() && stats.transfersPending == 0 && stats.patchesPending == 0 &&
                       (!visibility_ || demandIsCurrent_) &&
                       !(lightMaps_ && lightMaps_->couldBeFiner());
  // Shares do not need what is left of the sums.
  const bool goesOn = usesShares(in, options) ? sumIsLimited_ && !isReady : isLimited_;
  const bool shadedNow = !image_ || viewChanged || lights_.changed() || imageIsStale_ ||
                         patchesChanged_ || shadingChanged || prtChanged || isHasty_ || goesOn;
  const bool samplesOtherwise = options.antialias != options_.antialias;
  if (!holdsMix_ &&
      (shadedNow || samplesOtherwise || options.biasCompensation != options_.biasCompensation ||
       options.shareMemory != options_.shareMemory))
    restartShares();
  if (shadedNow) {
    isHasty_ = image_ && view_ != in.view && options.block > 1;
    view_ = in.view;
    image_ = shade(in, options, vec2(0.0f), stages);
    lights_.clearChanged();
    imageIsStale_ = patchesChanged_ = false;
    samples_ = 0;
    compensation_.outdate();
  }
  const bool refinesOtherwise = options.refinement() != options_.refinement() || samplesOtherwise;
  options_ = options;
  lightMapTexel_ = stats.lightMapTexel;
  lightOnly_ = in.lightOnly;
  part_ = in.part;
  started_ = true;

  // 6. If nothing else is pending, compensate bias and antialias: one sample per frame.
  if (samplesOtherwise) {
    samples_ = 0;
    compensation_.outdate();
  }
  const int samples = options.antialias > 1 ? options.antialias : 0;
  if (usesShares(in, options)) {
    if (isReady && !shadedNow) goOnWithShares(in, options, stages);
    out.settled = isReady && !isHasty_ && shares_.isDone() && !holdsMix_;
    out.radiance = options.biasCompensation ? compensation_.scale(in.backend, image_) : image_;
    if (out.settled || holdsMix_) out.radiance = mixed_;
  } else {
    if (isReady && samples_ < samples && !shadedNow) addSample(in, options, stages);
    out.settled = isReady && !isHasty_ && !isLimited_ && samples_ == samples;
    out.radiance = out.settled && samples > 0 ? mean_ : image_;
    if (options.biasCompensation) {
      out.radiance = compensateBias(in, options, out.radiance, out.settled, stages);
      out.settled = out.settled && compensation_.isWhole(in.view);
    }
  }

  if (samples > 0 && (out.settled || (usesShares(in, options) && holdsMix_)))
    out.smoothEdges = smoothEdges();

  // 7. Then refine, until something changes.
  if (!out.settled || shadedNow || refinesOtherwise) refinement_.restart();
  refineSettled(in, options, shadedNow, stages, out, stats);
  count(in, options, out, stats);
  if (wantsVisibility && !visibility_) stats.visibilityBytesNeeded = visibilityNeeds_;
  return out;
}

// Smooth edges of an antialiased picture. Without lamps all light is stored on surfaces, whose
// picture is antialiased later.
SmoothEdges ManyLights::smoothEdges() const {
  return lights_.live() > 0 ? SmoothEdges::all : SmoothEdges::lights;
}

// The state after the frame.
void ManyLights::count(const FrameInputs& in, const Options& options, const GiOutput& out,
                       ManyLightsStats& stats) const {
  const int pending = lights_.pending();
  stats.glWaits = in.backend.counts().waits - waitsBefore_;
  stats.glUploads = kernels_->lightCounts().bytesUploaded - uploadsBefore_;
  stats.vpls = lights_.live();
  stats.pending = pending;
  stats.oldestFrames = lights_.oldestFrames();
  // An estimate: frames that refresh as many VPLs as this one, then frames for finer maps, and one
  // per antialiasing sample.
  const int aFrame = std::max({1, stats.updates, stats.mapsRendered});
  const int exchange = paths_.isAtRest() ? 0 : LightPaths::kRestingFrames;
  const int sharper = mapsAFrame(kernels_->traits(), options, mapRooms_.scale());
  const int samples = options.antialias > 1 ? options.antialias : 0;
  stats.framesUntilSettled = std::max((pending + aFrame - 1) / aFrame, exchange) +
                             (stats.mapsToSharpen + sharper - 1) / sharper +
                             (usesShares(in, options) ? shares_.stepsLeft() : samples - samples_);
  // Work that cannot be estimated, such as replaced paths, takes at least one frame.
  if (out.settled)
    stats.framesUntilSettled = 0;
  else
    stats.framesUntilSettled = std::max(stats.framesUntilSettled, 1);
  stats.mergedPasses = mergedPasses_;
  stats.passesSaved = passesSaved_;
  stats.interpolatedShare = interpolatedShare_;
  stats.samplesPerPixel = shares_.isDone() ? std::max(samples, 1) : std::max(samples_, 1);
  stats.mapsHeld = lights_.mapsHeld();
  stats.mapsWithoutRoom = lights_.withoutMap();
  stats.mapBytes = kernels_->lightCounts().mapBytes;
  stats.shareBytes = shares_.bytes();
  stats.lightsWithoutShare = shares_.lightsWithoutShare();
  if (visibility_) stats.visibilityBytes = visibility_->bytes();
  if (lightMaps_) {
    const LightMaps* part = partLights_.maps();
    stats.lightMapBytes = lightMaps_->bytes() + (part ? part->bytes() : 0);
    stats.lightMapTexel = lightMapTexel_;
  }
  if (prt_) stats.transferBytes = prt_->bytes();
}

void ManyLights::updateLights(const FrameInputs& in, const Options& options,
                              ManyLightsStats& stats) {
  const RenderSceneChanges changes = std::exchange(unsampled_, {});
  const bool surfacesChanged = !started_ || changes.surfaces();
  const RayCaster& rays = in.services.rays();
  std::span<const MoverFinder::Mover> movers;
  if (surfacesChanged) {
    movers = in.services.movers();
    pointVisibility_.outdate(changes, movers);
    lampImportance_.outdate(changes, movers);
  }
  // While the camera moves the samples are kept; when it rests they are chosen for its view.
  const bool isSame = started_ && !surfacesChanged && choiceIsCurrent_ && in.view == view_;
  View chosenFor = isSame ? *chosenFor_ : steadyView(in.view, rays);
  choiceIsCurrent_ = !started_ || in.view == view_ || chosenFor == chosenFor_;
  if (!choiceIsCurrent_) chosenFor = *chosenFor_;
  const bool choosesOtherwise =
      chosenFor != chosenFor_ || options.clampDistance != options_.clampDistance;
  chosenFor_ = chosenFor;
  if (paths_.update(in.scene, rays, changes, movers, options.counts(), options.maxPaths) ||
      choosesOtherwise || !lampsAreCurrent_) {
    shareLamps(in, options, chosenFor, surfacesChanged && !changes.rebuilt);
    VplSet set = chooseForView(paths_.set(in.scene, true, lampShares_), options.counts(), in.scene,
                               rays, chosenFor, options.clampDistance, pointVisibility_);
    divideSuns(set.vpls, in.scene, rays, &chosenFor, options.sunMaps);
    findFootprints(paths_.lights(), set.vpls);
    lights_.want(std::move(set.vpls), set.pathIds);
  }
  if (!started_ || !changes.none()) {
    lights_.setGains(gainsOf(paths_.lights()));
    controls_ = LightControls(in.scene, paths_.lights());
  }
  const LightPaths::Work& work = paths_.work();
  stats.raysTraced = work.rays;
  stats.pathsWalked = work.walked;
  stats.pathsReplaced = work.replaced;
  stats.pathsKept = work.kept;
  stats.pathsPending = work.pending;
  if (surfacesChanged) {
    std::function<bool(const shared::Vpl&)> isSpared;
    if (visibility_ && visibility_->moversFound() == movers.size())
      isSpared = [&](const shared::Vpl& vpl) { return visibility_->moversAreHidden(vpl); };
    stats.mapsSpared = lights_.markStale(movers, isSpared);
  }
  // The backend loses all maps when their number changes.
  const int slots = lights_.slots() + Refinement::slots(options.refinement());
  const Options::MapRooms rooms = options.mapRooms(slots);
  if (slots != mapSlots_ || rooms != mapRooms_) lights_.loseMaps();
  mapSlots_ = slots;
  mapRooms_ = rooms;
  kernels_->reserveShadowMaps(slots, rooms.coarse, rooms.fine);
  lights_.showOnlyMapped(!options.useVisibility());
}

// Shares out the samples on lamps for the view. While an edit goes on, they stay shared out as they
// are unless much changes, so that few move; at rest they are those of a fresh start.
void ManyLights::shareLamps(const FrameInputs& in, const Options& options, const View& view,
                            bool isEditing) {
  std::vector<LampShare> lamps =
      lampImportance_.of(in.scene, in.services.rays(), paths_, view, options.clampDistance);
  std::vector<VplId> ids = emitterIds(paths_.lights());
  const bool stays = isEditing && started_ && ids == lampIds_ && isNear(lamps, lampShares_);
  lampsAreCurrent_ = !stays || lamps == lampShares_;
  if (stays) return;
  lampShares_ = std::move(lamps);
  lampIds_ = std::move(ids);
}

int ManyLights::refreshLights(const Options& options) {
  RefreshWork moved, stale;
  moved.shadowMaps = stale.shadowMaps = 1;
  if (kernels_->traits().tracesShadowMaps) {
    const auto side = static_cast<uint64_t>(options.mapResolution);
    moved.rays = stale.rays = side * side;
  }
  if (prt_) {
    moved.rays += prt_->raysPerLight();
    stale.rays += prt_->raysPerLight();
  }
  if (visibility_) moved.visibilityTests = visibility_->testsPerColumn();
  if (lightMaps_) moved.lightMapTexels = 2 * lightMaps_->texels();  // subtracted and added again
  RefreshBudget budget = options.budget();
  // Without one of its tiles a sun leaves a part of the first picture dark.
  if (!started_ && budget.vpls > 0) budget.vpls += lights_.missingSunTiles();
  return lights_.refresh(budget, moved, stale);
}

// Finds again which maps the view needs, if anything changed that affects this.
void ManyLights::updateMaps(const FrameInputs& in, const Options& options, ManyLightsStats& stats) {
  const auto slots = static_cast<size_t>(lights_.slots());
  const bool needsAll =
      !visibility_ || !visibility_->asksForAll() ||
      (options.speculars && kernels_->traits().specularsTakeAllMaps && hasGlossy(in.scene));
  if (needsAll)
    lights_.needMaps(std::vector<uint8_t>(slots, 1));
  else if (lights_.changed() || patchesChanged_ || in.changes.surfaces() || in.view != view_ ||
           options.useVisibility() != options_.useVisibility() ||
           options.speculars != options_.speculars)
    lights_.needMaps(shadowMapDemand(*visibility_, in.scene, in.view));
  // A path is refreshed as a whole, even if it has more VPLs than the budget.
  const int maps = std::max(mapsAFrame(kernels_->traits(), options, 1), stats.updates);
  const int refining = Refinement::slots(options.refinement());
  stats.mapsRendered =
      lights_.updateMaps(*kernels_, {std::max(options.mostMaps() - refining, 1), maps});
  if (kernels_->traits().tracesShadowMaps) {
    const auto side = static_cast<uint64_t>(options.mapResolution);
    stats.mapRays = side * side * static_cast<uint64_t>(stats.mapsRendered);
  }
  if (visibility_)
    lightProxies_.update(lights_.table(), groupsOf(in, options.groupShare, lights_.slots()));
}

// Only when all other work is done, because the frame after an edit is busy enough; but at once for
// the hard shadows of a lamp.
void ManyLights::sharpenMaps(const Options& options, ManyLightsStats& stats) {
  const int scale = mapRooms_.scale();
  if (scale == 1) return;
  const bool isDone = lights_.pending() == 0 && stats.updates == 0 && stats.mapsRendered == 0 &&
                      paths_.isAtRest() && choiceIsCurrent_ && lampsAreCurrent_;
  stats.mapsSharpened =
      isDone ? lights_.sharpenMaps(*kernels_, mapsAFrame(kernels_->traits(), options, scale))
             : lights_.sharpenHardLights(*kernels_, kHardMapsAFrame);
  stats.mapsToSharpen = lights_.coarse();
}

std::shared_ptr<RadianceImage> ManyLights::shade(const FrameInputs& in, const Options& options,
                                                 vec2 jitter, StageTimer& stages) {
  const bool isMiddle = jitter == vec2(0.0f);
  if (!isMiddle || !gbufferIsCurrent_) in.backend.renderGBuffer(in.view, jitter);
  gbufferIsCurrent_ = isMiddle;
  stages.end(kGBufferStage);
  shared::ShadingParams params = shadingOf(options, isMiddle && isHasty_);
  // Shares have all highlights; without them, the sums have all when they are complete.
  const bool isLong = usesShares(in, options) ? isLong_ : sumIsLimited_;
  if (isMiddle && in.part == LightPart::all) {
    params.block.z = isHasty_ ? kMostMoving : kMostAtEdges;
    params.block.w = isLong ? 1.0f : 0.0f;
  }
  const ManyLightsCounts before = kernels_->lightCounts();
  const bool isWhole = in.part == LightPart::all;
  if (isWhole) partLights_.forget();
  std::vector<shared::Vpl> vpls =
      isWhole ? lights_.table().summedInOrder() : takePart(in, options, isMiddle).summedInOrder();
  if (visibility_) {
    const LightProxies& lightProxies = isWhole ? lightProxies_ : partLights_.lightProxies();
    vpls.insert(vpls.end(), lightProxies.lights().begin(), lightProxies.lights().end());
    const PatchLights patches(*visibility_, isWhole ? lightMaps_.get() : partLights_.maps(),
                              options.mergePasses, isWhole ? prt_.get() : nullptr, &lightProxies);
    kernels_->sumVpls(vpls, params, &patches);
  } else {
    kernels_->sumVpls(vpls, params, nullptr);
  }
  if (isMiddle) {
    sumIsLimited_ = kernels_->sumIsLimited();
    isLimited_ = sumIsLimited_ || params.block.w != 0.0f;
    if (!isHasty_) isLong_ = kernels_->sumIsLong();
  }
  const ManyLightsCounts after = kernels_->lightCounts();
  mergedPasses_ = static_cast<int>(after.mergedPasses - before.mergedPasses);
  passesSaved_ = static_cast<int>(after.passesSaved - before.passesSaved);
  interpolatedShare_ = static_cast<float>(after.pixelsInterpolated - before.pixelsInterpolated) /
                       static_cast<float>(in.view.width * in.view.height);
  stages.end(kLightSumsStage);
  std::shared_ptr<RadianceImage> image = kernels_->compose(in.lightOnly);
  if (in.part == LightPart::indirect) {
    kernels_->sumVpls({}, params, nullptr);
    // Without emissive surfaces and the sky.
    image = in.backend.difference(image, kernels_->compose(in.lightOnly));
  }
  stages.end(kCompositionStage);
  return image;
}

// The lights of the shown part; `isNew`: they may differ from those of the last call.
LightSampleTable ManyLights::takePart(const FrameInputs& in, const Options& options, bool isNew) {
  LightSampleTable lights = lights_.table();
  const bool isDirect = in.part == LightPart::direct;
  lights.sumOnly([&](const LightSample& l) { return (l.id.bounce == 0) == isDirect; });
  if (visibility_ && isNew)
    partLights_.update(in.scene, *visibility_, lights,
                       {options.useLightMaps(), lightMapOptions(options)},
                       groupsOf(in, options.groupShare, lights_.slots()));
  return lights;
}

Inspection ManyLights::inspect() const {
  Inspection out;
  out.lights = lights_.table().samples;
  out.lightsLeaveOutSky = paths_.counts().withoutSky;
  out.lightsLeaveOutSurfaces = paths_.counts().withoutSurfaces;
  if (visibility_) out.patches = std::make_shared<DatabasePatches>(*visibility_);
  if (visibility_ && lightMaps_)
    out.texels = std::make_shared<LightMapTexels>(*visibility_, *lightMaps_);
  out.elements = meshes_.elements();
  out.links = linked_.links();
  if (!out.links) out.links = meshes_.links();
  if (prt_) {
    out.transfer = [prt = prt_.get()](uint32_t object) {
      if (object >= prt->objects()) return TransferState::none;
      if (prt->hasTransfer(object)) return TransferState::ready;
      return prt->wantsTransfer(object) ? TransferState::pending : TransferState::none;
    };
    out.points = [prt = prt_.get()] {
      std::vector<InspectedPoint> points;
      for (uint32_t object = 0; object < prt->objects(); ++object)
        for (const vec3& place : prt->lightPoints(object)) points.push_back({place, vec3(0.0f)});
      return points;
    };
  }
  return out;
}

MethodInfo manyLightsInfo() {
  return {"many_lights",
          "Many lights",
          "Barczak, Interactive Illumination Using Large Sets of Point Lights, 2006, chapter 4",
          manyLightsParameters().specs(),
          manyLightsStatistics().specs(),
          {std::begin(kManyLightsStages), std::end(kManyLightsStages)},
          [](Backend& backend) {
            return std::make_unique<ManyLights>(backend.kernels<ManyLightsKernels>("many_lights"));
          },
          {{Service::rays, Service::movers, Service::charts},
           {kernelNeed<ManyLightsKernels>("many_lights")}},
          {{Capability::lights, ""},
           {Capability::patches, "with the technique visibility or light_maps"},
           {Capability::texels, "with the technique light_maps"},
           {Capability::elements, "with indirect=meshes"},
           {Capability::transfer, "with prt"},
           {Capability::points, "with prt"},
           {Capability::links, "with indirect=links or indirect=meshes"}},
          {},
          "technique"};
}

}  // namespace lamplighter
