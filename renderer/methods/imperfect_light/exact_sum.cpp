#include "renderer/methods/imperfect_light/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/bias_compensation/bias_compensation_filter.h"
#include "renderer/methods/pixel_jitter.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

// Work per frame: lights × pixels, and texels of maps. About 80 ms on two cores.
constexpr double kSumsAFrame = 32e6, kTracedAFrame = 600e3;
constexpr int kCompensatedPixelsPerFrame = 1 << 15;

int compensatedRowsPerFrame(const View& view) {
  return std::max(1, kCompensatedPixelsPerFrame / view.width);
}

size_t lightsAFrame(const View& view, const ImperfectParameters& parameters, int antialias) {
  const double pixels = static_cast<double>(view.width) * static_cast<double>(view.height);
  double work = antialias * pixels / kSumsAFrame;
  if (parameters.settle == ImperfectRest::maps)
    work += std::pow(static_cast<double>(parameters.settledResolution), 2.0) / kTracedAFrame;
  return static_cast<size_t>(std::clamp(1.0 / std::max(work, 1e-6), 8.0, 256.0));
}

// Renders the G-buffer of a shifted picture. Returns whether it has no shift.
bool showShifted(const FrameInputs& in, size_t sample, int antialias) {
  const vec2 jitter = antialias > 1 ? pixelJitter(static_cast<int>(sample), antialias) : vec2(0.0f);
  in.backend.renderGBuffer(in.view, jitter);
  return jitter == vec2(0.0f);
}

}  // namespace

std::vector<vec3> reflectancesOf(const FrameInputs& in, const SurfacePictureOptions& options) {
  const View& view = in.view;
  const GBufferView gbuffer = in.backend.hostGBuffer();
  const auto width = static_cast<size_t>(view.width);
  std::vector<vec3> out(width * static_cast<size_t>(view.height), vec3(0.0f));
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const Material& m =
          in.scene.materials[static_cast<size_t>(in.scene.objects[p.object].material)];
      // Only glossy surfaces need the position on the triangle.
      vec2 weights(0.0f);
      if (options.speculars && mayBeGlossy(m)) weights = SeenTriangle(in.scene, p).weights;
      const PixelReflectance r = reflectanceOf(in.scene, p, weights, view.eye, options);
      out[static_cast<size_t>(y) * width + static_cast<size_t>(x)] =
          (1.0f / kPi) * (r.diffuse + r.lobe);
    }
  });
  return out;
}

void ExactSum::restart() {
  isDone_ = false;
  summed_ = 0;
  compensationRow_ = 0;
  irradiance_.clear();
}

void ExactSum::setLights(std::vector<SceneVpl> samples, std::vector<MapLight> lights) {
  samples_ = std::move(samples);
  lights_ = std::move(lights);
  hasLights_ = true;
  restart();
}

int ExactSum::framesLeft(const View& view, const ImperfectParameters& parameters, int antialias,
                         size_t lights) const {
  if (isDone_) return 0;
  const size_t left = hasLights_ ? lights_.size() - summed_ : lights;
  return 1 + static_cast<int>(left / lightsAFrame(view, parameters, antialias)) +
         (view.height - compensationRow_) / compensatedRowsPerFrame(view);
}

uint64_t ExactSum::goOn(const FrameInputs& in, const Subject& subject, bool& gbufferIsCurrent) {
  if (summed_ < lights_.size() || irradiance_.empty())
    return addLightsOf(in, subject, gbufferIsCurrent);
  addCompensation(in, subject);
  return 0;
}

uint64_t ExactSum::addLightsOf(const FrameInputs& in, const Subject& subject,
                               bool& gbufferIsCurrent) {
  const ImperfectParameters& parameters = subject.parameters;
  const InterleavedOptions options = parameters.interleaved();
  if (irradiance_.empty())
    irradiance_.assign(static_cast<size_t>(subject.antialias),
                       Image(in.view.width, in.view.height));
  const auto left = std::span(lights_).subspan(summed_);
  const auto now =
      left.first(std::min(left.size(), lightsAFrame(in.view, parameters, subject.antialias)));
  uint64_t rays = 0;
  std::vector<float> drawn;
  int resolution = options.map.resolution;
  const bool traces = parameters.settle == ImperfectRest::maps;
  if (traces) {
    resolution = parameters.settledResolution;
    rays = maps_.draw(in.scene, in.services.rays(), now, resolution);
  } else {
    drawn = imperfectMaps(now, summed_, subject.pool, options.map);
  }
  const std::span<const float> maps = traces ? maps_.maps() : std::span<const float>(drawn);
  summed_ += now.size();
  const bool isLast = summed_ == lights_.size();
  if (isLast) sum_ = Image(in.view.width, in.view.height);
  for (size_t k = 0; k < irradiance_.size(); ++k) {
    gbufferIsCurrent = showShifted(in, k, subject.antialias);
    addLights(in.backend.hostGBuffer(), now, maps, resolution, options, irradiance_[k]);
    if (!isLast) continue;
    const std::vector<vec3> reflectance = reflectancesOf(in, subject.pixels);
    const float share = 1.0f / static_cast<float>(irradiance_.size());
    for (size_t i = 0; i < sum_.pixels.size(); ++i)
      sum_.pixels[i] += share * reflectance[i] * irradiance_[k].pixels[i];
  }
  const bool isCompensated = parameters.biasCompensation && parameters.clampDistance > 0.0f;
  isDone_ = isLast && !isCompensated;
  return rays;
}

void ExactSum::addCompensation(const FrameInputs& in, const Subject& subject) {
  std::vector<SceneVpl> lights(subject.direct.begin(), subject.direct.end());
  lights.insert(lights.end(), samples_.begin(), samples_.end());
  BiasCompensation::Options options;
  options.bounces = subject.parameters.bounces;
  options.emission = false;  // it is in the direct light
  options.clampDistance = subject.parameters.clampDistance;
  options.seed = static_cast<uint32_t>(subject.parameters.seed);
  options.white = subject.pixels.white;
  options.speculars = subject.pixels.speculars;
  options.leastRoughness = subject.pixels.leastRoughness;
  const BiasCompensation compensation(in.scene, in.services.rays(), lights, options);
  compensation_.resize(sum_.pixels.size());
  const int last = std::min(in.view.height, compensationRow_ + compensatedRowsPerFrame(in.view));
  compensation.findRows(in.view, vec2(0.0f), compensationRow_, last, compensation_);
  compensationRow_ = last;
  if (compensationRow_ < in.view.height) return;
  addSmoothed(compensation_, filterRadius(1, in.view.height), sum_);
  compensation_ = {};
  isDone_ = true;
}

}  // namespace lamplighter
