#include "renderer/methods/imperfect_light/imperfect_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/methods/imperfect_light/stages.h"
#include "renderer/sampling/view_points.h"

namespace lamplighter {
namespace {

// Number of blocks of points, which maps use in turn.
constexpr uint32_t kBlocks = 16;
// Number of visible points for the density of occluder points, if view samples are pixels.
constexpr int kPointViewSamples = 128;
// Rays per frame for the choice at rest.
constexpr uint64_t kChoosingRaysAFrame = 100'000;

uint32_t powerBelow(int value) { return std::bit_floor(static_cast<uint32_t>(std::max(value, 1))); }

}  // namespace

void ImperfectPicture::update(const FrameInputs& in, const ImperfectParameters& wanted,
                              const EndStage& endStage) {
  ImperfectParameters parameters = wanted;
  parameters.resolution = static_cast<int>(powerBelow(wanted.resolution));
  // The window changes this parameter in each frame; no picture depends on it.
  static_cast<FrameBudgetParameters&>(parameters) = {};
  const RayCaster& rays = in.services.rays();
  scene_ = &in.scene;
  caster_ = &rays;
  const bool isOther = !isStarted_ || parameters != parameters_;
  const bool surfacesChanged = !isStarted_ || in.changes.surfaces();
  std::span<const MoverFinder::Mover> movers;
  if (surfacesChanged) movers = in.services.movers();
  parameters_ = parameters;
  ReflectiveMapOptions options;
  options.texels = parameters.potentialLights;
  options.bounces = parameters.bounces;
  options.seed = static_cast<uint32_t>(parameters.seed);
  const bool mapChanged = map_.update(in.scene, rays, in.changes, movers, options);
  endStage(kReflectiveMapStage);

  const bool viewChanged = in.view != view_;
  view_ = in.view;
  const View chosenFor =
      parameters.adapt == ViewAdaption::steady ? steadyView(in.view, rays) : in.view;
  const bool isOtherView =
      chosenFor != chosenFor_ || (parameters.viewChoice != ViewChoice::fixed && viewChanged);
  chosenFor_ = chosenFor;
  const bool choosesAnew = isOther || mapChanged || surfacesChanged || isOtherView;
  if (choosesAnew) choose(in);
  endStage(kImportanceStage);

  const bool pointsChanged = updatePoints(in);
  endStage(kOccluderPointsStage);
  isStarted_ = true;
  rays_ = map_.rays();
  if (surfacesChanged) exact_.outdateMaps();
  if (viewChanged || !in.changes.none()) reflectanceIsCurrent_ = false;
  if (choosesAnew || pointsChanged || viewChanged || !in.changes.none()) {
    isOutdated_ = true;
    exact_.restart();
  }
}

bool ImperfectPicture::updatePoints(const FrameInputs& in) {
  OccluderPointOptions options;
  options.pointsPerMap = std::max(powerBelow(parameters_.occluderPoints), 64u);
  options.points = kBlocks * options.pointsPerMap;
  options.importance.seed = static_cast<uint32_t>(parameters_.seed);
  std::vector<vec3> seen, sending;
  if (parameters_.adapt != ViewAdaption::off) {
    for (size_t i = 0; i < viewSamples_.size(); ++i) seen.push_back(viewSamples_.position(i));
    if (parameters_.twoSided)
      for (const MapLight& light : lights_) sending.emplace_back(light.vpl.position);
  }
  return points_.update(in.scene, in.changes, seen, sending, options);
}

void ImperfectPicture::choose(const FrameInputs& in) {
  const auto seed = static_cast<uint32_t>(parameters_.seed);
  viewSamples_ = raySamples(
      in.scene, in.services.rays(), *chosenFor_,
      parameters_.viewChoice == ViewChoice::fixed ? parameters_.viewSamples : kPointViewSamples);
  if (parameters_.viewChoice == ViewChoice::fixed) {
    importance_ = bidirectionalImportance(map_, viewSamples_, parameters_.clampDistance);
  } else {
    in.backend.renderGBuffer(view_, vec2(0.0f));
    importance_ =
        blurred(map_, bidirectionalImportance(
                          map_, in.backend.hostGBuffer(), view_,
                          {parameters_.viewSamples, parameters_.viewChoice == ViewChoice::guided,
                           parameters_.clampDistance, seed}));
  }
  chosen_ = chooseLights(map_, importance_, choiceOptions());
  lights_ = bounded(chosen_.lights);
  exact_.dropLights();
  visible_.restart(importance_);
}

LightChoiceOptions ImperfectPicture::choiceOptions() const {
  LightChoiceOptions choice;
  choice.count = parameters_.bouncedSamples;
  choice.defence = parameters_.adapt == ViewAdaption::off ? 1.0f : 0.01f * parameters_.defence;
  choice.seed = static_cast<uint32_t>(parameters_.seed);
  if (parameters_.betweenTexels) choice.between = &view_;
  return choice;
}

// Limits the irradiance that a sample gives to any point to the mean irradiance of the view by all
// samples.
std::vector<MapLight> ImperfectPicture::bounded(std::span<const SceneVpl> lights) const {
  const double mean = std::accumulate(importance_.begin(), importance_.end(), 0.0);
  return boundedLights(lights, parameters_.clampDistance,
                       parameters_.asPublished ? 0.0f : static_cast<float>(mean));
}

// The samples of the exact sum: chosen again, with occlusion.
void ImperfectPicture::chooseForRest() {
  const ChosenLights chosen =
      parameters_.raysChoose ? chooseLights(map_, visible_.importance(), choiceOptions()) : chosen_;
  std::vector<SceneVpl> samples = parameters_.betweenTexels ? chosen.lights : mergedLights(chosen);
  std::vector<MapLight> lights = bounded(samples);
  exact_.setLights(std::move(samples), std::move(lights));
}

int ImperfectPicture::framesLeft() const {
  return exact_.isDone() ? 0
                         : static_cast<int>(points_.pendingFrames()) +
                               exact_.framesLeft(view_, parameters_, antialias_, lights_.size());
}

std::shared_ptr<RadianceImage> ImperfectPicture::addTo(const FrameInputs& in, const Direct& direct,
                                                       int antialias,
                                                       const SurfacePictureOptions& options,
                                                       const EndStage& endStage) {
  antialias = std::max(antialias, 1);
  if (options != options_ || antialias != antialias_) {
    options_ = options;
    antialias_ = antialias;
    reflectanceIsCurrent_ = false;
    isOutdated_ = true;
  }
  bool isNew = direct.picture != under_ || !shown_;
  if (isOutdated_) {
    exact_.restart();
    renderQuick(in, *direct.gbufferIsCurrent);
    isNew = true;
  } else if (direct.isSettled && points_.isSettled() && !exact_.isDone()) {
    goOn(in, direct);
    isNew |= exact_.isDone();
  }
  endStage(kInterleavedStage);
  if (!isNew) return shown_;
  Image out = direct.picture->pixels();
  const Image& more = exact_.isDone() ? exact_.radiance() : quick_;
  tbb::parallel_for(size_t{0}, out.pixels.size(),
                    [&](size_t i) { out.pixels[i] += more.pixels[i]; });
  under_ = direct.picture;
  shown_ = std::make_shared<HostImage>(std::move(out));
  return shown_;
}

void ImperfectPicture::renderQuick(const FrameInputs& in, bool& gbufferIsCurrent) {
  if (!gbufferIsCurrent) in.backend.renderGBuffer(view_, vec2(0.0f));
  gbufferIsCurrent = true;
  const GBufferView gbuffer = in.backend.hostGBuffer();
  const InterleavedOptions interleaved = parameters_.interleaved();
  quick_ = blurredClasses(gbuffer, sumInterleaved(gbuffer, lights_, poolOf(points_), interleaved),
                          interleaved.side);
  if (!reflectanceIsCurrent_) reflectance_ = reflectancesOf(in, options_);
  reflectanceIsCurrent_ = true;
  tbb::parallel_for(size_t{0}, quick_.pixels.size(),
                    [&](size_t i) { quick_.pixels[i] *= reflectance_[i]; });
  isOutdated_ = false;
}

void ImperfectPicture::goOn(const FrameInputs& in, const Direct& direct) {
  if (exact_.hasLights()) {
    rays_ += exact_.goOn(in, {parameters_, options_, antialias_, poolOf(points_), direct.lights},
                         *direct.gbufferIsCurrent);
    return;
  }
  if (parameters_.raysChoose && !visible_.isDone(map_))
    rays_ += visible_.goOn(map_, viewSamples_, parameters_.clampDistance, in.services.rays(),
                           kChoosingRaysAFrame);
  if (!parameters_.raysChoose || visible_.isDone(map_)) chooseForRest();
}

}  // namespace lamplighter
