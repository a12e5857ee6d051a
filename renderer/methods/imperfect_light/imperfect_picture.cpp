#include "renderer/methods/imperfect_light/imperfect_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/corner_light/bias_compensation_filter.h"
#include "renderer/methods/imperfect_light/stages.h"
#include "renderer/methods/pixel_jitter.h"
#include "renderer/sampling/view_importance.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

// Blocks of points that maps take in turns.
constexpr uint32_t kBlocks = 16;
// Of an exact sum in a frame: lights × pixels, and texels of maps. Some 80 ms on two cores.
constexpr double kSumsAFrame = 32e6, kTracedAFrame = 600e3;

constexpr uint64_t kChoosingRaysAFrame = 100'000;
constexpr int kCornerPixelsAFrame = 1 << 15;

int rowsAFrame(const View& view) { return std::max(1, kCornerPixelsAFrame / view.width); }

uint32_t powerBelow(int value) { return std::bit_floor(static_cast<uint32_t>(std::max(value, 1))); }

// By pixel of the G-buffer: the share of even light that it sends to the eye, over π.
std::vector<vec3> reflectancesOf(const FrameInputs& in, const View& view,
                                 const SurfacePictureOptions& options) {
  const GBufferView gbuffer = in.backend.hostGBuffer();
  const auto width = static_cast<size_t>(view.width);
  std::vector<vec3> out(width * static_cast<size_t>(view.height), vec3(0.0f));
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const Material& m =
          in.scene.materials[static_cast<size_t>(in.scene.objects[p.object].material)];
      // Only gloss needs the place on the triangle.
      vec2 weights(0.0f);
      if (options.speculars && mayBeGlossy(m)) weights = SeenTriangle(in.scene, p).weights;
      const PixelReflectance r = reflectanceOf(in.scene, p, weights, view.eye, options);
      out[static_cast<size_t>(y) * width + static_cast<size_t>(x)] =
          (1.0f / kPi) * (r.diffuse + r.lobe);
    }
  });
  return out;
}

}  // namespace

OccluderPool ImperfectPicture::pool() const {
  const OccluderPointArrays& a = points_.arrays();
  OccluderPool out;
  out.points = {a.px.data(), a.py.data(), a.pz.data(),   a.nx.data(),
                a.ny.data(), a.nz.data(), a.area.data(), a.px.size()};
  out.pointsPerMap = points_.options().pointsPerMap;
  return out;
}

void ImperfectPicture::update(const FrameInputs& in, const ImperfectParameters& parameters,
                              const EndStage& endStage) {
  const RayCaster& rays = in.services.rays();
  scene_ = &in.scene;
  caster_ = &rays;
  const bool isOther = !isStarted_ || parameters != parameters_;
  const bool surfacesChanged = !isStarted_ || in.changes.surfaces();
  std::span<const MoverFinder::Mover> movers;
  if (surfacesChanged) movers = in.services.movers();
  parameters_ = parameters;
  parameters_.resolution = static_cast<int>(powerBelow(parameters.resolution));
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

  OccluderPointOptions points;
  points.pointsPerMap = std::max(powerBelow(parameters.occluderPoints), 64u);
  points.points = kBlocks * points.pointsPerMap;
  points.importance.seed = static_cast<uint32_t>(parameters.seed);
  std::vector<vec3> seen, sending;
  if (parameters.adapt != ViewAdaption::off) {
    for (size_t i = 0; i < viewSamples_.size(); ++i)
      seen.emplace_back(viewSamples_.x[i], viewSamples_.y[i], viewSamples_.z[i]);
    if (parameters.twoSided)
      for (const MapLight& light : lights_) sending.emplace_back(light.vpl.position);
  }
  const bool pointsChanged = points_.update(in.scene, in.changes, seen, sending, points);
  endStage(kOccluderPointsStage);
  isStarted_ = true;
  rays_ = map_.rays();
  if (surfacesChanged) restMaps_.outdate();
  if (viewChanged || !in.changes.none()) reflectanceIsCurrent_ = false;
  if (choosesAnew || pointsChanged || viewChanged || !in.changes.none()) {
    isOutdated_ = true;
    restart();
  }
}

void ImperfectPicture::choose(const FrameInputs& in) {
  const auto seed = static_cast<uint32_t>(parameters_.seed);
  viewSamples_ =
      raySamples(in.scene, in.services.rays(), *chosenFor_,
                 parameters_.viewChoice == ViewChoice::fixed ? parameters_.viewSamples : 128);
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
  hasRestLights_ = false;
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

// No sample lights any place more than all together light the view in the mean.
std::vector<MapLight> ImperfectPicture::bounded(std::span<const SceneVpl> lights) const {
  const double mean = std::accumulate(importance_.begin(), importance_.end(), 0.0);
  return boundedLights(lights, parameters_.clampDistance,
                       parameters_.asPublished ? 0.0f : static_cast<float>(mean));
}

// The samples of the exact sum: chosen anew, with what stands between.
void ImperfectPicture::chooseForRest() {
  const ChosenLights chosen =
      parameters_.raysChoose ? chooseLights(map_, visible_.importance(), choiceOptions()) : chosen_;
  restSamples_ = parameters_.betweenTexels ? chosen.lights : mergedLights(chosen);
  restLights_ = bounded(restSamples_);
  hasRestLights_ = true;
}

// Lights that the exact sum gets in a frame.
size_t ImperfectPicture::restLightsAFrame() const {
  const double pixels = static_cast<double>(view_.width) * static_cast<double>(view_.height);
  double work = antialias_ * pixels / kSumsAFrame;
  if (parameters_.settle == ImperfectRest::maps)
    work += std::pow(static_cast<double>(parameters_.settledResolution), 2.0) / kTracedAFrame;
  return static_cast<size_t>(std::clamp(1.0 / std::max(work, 1e-6), 8.0, 256.0));
}

int ImperfectPicture::framesLeft() const {
  if (isExact_) return 0;
  return static_cast<int>(points_.pendingFrames()) + 1 +
         static_cast<int>((hasRestLights_ ? restLights_.size() - summed_ : lights_.size()) /
                          restLightsAFrame()) +
         (view_.height - cornerRow_) / rowsAFrame(view_);
}

void ImperfectPicture::restart() {
  isExact_ = false;
  summed_ = 0;
  cornerRow_ = 0;
  irradiance_.clear();
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
    restart();
    renderQuick(in, *direct.gbufferIsCurrent);
    isNew = true;
  } else if (direct.isSettled && points_.isSettled() && !isExact_) {
    goOn(in, direct);
    isNew |= isExact_;
  }
  endStage(kInterleavedStage);
  if (!isNew) return shown_;
  Image out = direct.picture->pixels();
  const Image& more = isExact_ ? sum_ : quick_;
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
  quick_ = blurredClasses(gbuffer, sumInterleaved(gbuffer, lights_, pool(), interleaved),
                          interleaved.side);
  if (!reflectanceIsCurrent_) reflectance_ = reflectancesOf(in, view_, options_);
  reflectanceIsCurrent_ = true;
  tbb::parallel_for(size_t{0}, quick_.pixels.size(),
                    [&](size_t i) { quick_.pixels[i] *= reflectance_[i]; });
  isOutdated_ = false;
}

void ImperfectPicture::goOn(const FrameInputs& in, const Direct& direct) {
  if (!hasRestLights_) {
    if (parameters_.raysChoose && !visible_.isDone(map_))
      rays_ += visible_.goOn(map_, viewSamples_, parameters_.clampDistance, in.services.rays(),
                             kChoosingRaysAFrame);
    if (!parameters_.raysChoose || visible_.isDone(map_)) chooseForRest();
  } else if (summed_ < restLights_.size() || irradiance_.empty())
    addRestLights(in, *direct.gbufferIsCurrent);
  else
    addCorners(in, direct.lights);
}

// Renders the G-buffer of a shifted picture. Returns whether it has no shift.
bool ImperfectPicture::showShifted(const FrameInputs& in, size_t sample) {
  const vec2 jitter =
      antialias_ > 1 ? pixelJitter(static_cast<int>(sample), antialias_) : vec2(0.0f);
  in.backend.renderGBuffer(view_, jitter);
  return jitter == vec2(0.0f);
}

void ImperfectPicture::addRestLights(const FrameInputs& in, bool& gbufferIsCurrent) {
  const InterleavedOptions options = parameters_.interleaved();
  if (irradiance_.empty())
    irradiance_.assign(static_cast<size_t>(antialias_), Image(view_.width, view_.height));
  const auto lights = std::span(restLights_).subspan(summed_);
  const auto now = lights.first(std::min(lights.size(), restLightsAFrame()));
  std::vector<float> drawn;
  int resolution = options.map.resolution;
  const bool traces = parameters_.settle == ImperfectRest::maps;
  if (traces) {
    resolution = parameters_.settledResolution;
    rays_ += restMaps_.draw(in.scene, in.services.rays(), now, resolution);
  } else {
    drawn = imperfectMaps(now, summed_, pool(), options.map);
  }
  const std::span<const float> maps = traces ? restMaps_.maps() : std::span<const float>(drawn);
  summed_ += now.size();
  const bool isLast = summed_ == restLights_.size();
  if (isLast) sum_ = Image(view_.width, view_.height);
  for (size_t k = 0; k < irradiance_.size(); ++k) {
    gbufferIsCurrent = showShifted(in, k);
    addLights(in.backend.hostGBuffer(), now, maps, resolution, options, irradiance_[k]);
    if (!isLast) continue;
    const std::vector<vec3> reflectance = reflectancesOf(in, view_, options_);
    const float share = 1.0f / static_cast<float>(irradiance_.size());
    for (size_t i = 0; i < sum_.pixels.size(); ++i)
      sum_.pixels[i] += share * reflectance[i] * irradiance_[k].pixels[i];
  }
  isExact_ = isLast && !hasCorners();
}

// The light that the clamp of 1/d² removes.
void ImperfectPicture::addCorners(const FrameInputs& in, std::span<const SceneVpl> direct) {
  std::vector<SceneVpl> lights(direct.begin(), direct.end());
  lights.insert(lights.end(), restSamples_.begin(), restSamples_.end());
  BiasCompensation::Options options;
  options.bounces = parameters_.bounces;
  options.emission = false;
  options.clampDistance = parameters_.clampDistance;
  options.seed = static_cast<uint32_t>(parameters_.seed);
  options.white = options_.white;
  options.speculars = options_.speculars;
  options.leastRoughness = options_.leastRoughness;
  const BiasCompensation compensation(in.scene, in.services.rays(), lights, options);
  corners_.resize(sum_.pixels.size());
  const int last = std::min(view_.height, cornerRow_ + rowsAFrame(view_));
  compensation.findRows(view_, vec2(0.0f), cornerRow_, last, corners_);
  cornerRow_ = last;
  if (cornerRow_ < view_.height) return;
  addSmoothed(corners_, filterRadius(1, view_.height), sum_);
  corners_ = {};
  isExact_ = true;
}

}  // namespace lamplighter
