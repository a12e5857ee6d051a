// The exact sum of bounced light for a picture at rest: all samples at all pixels, in steps.
#pragma once

#include <span>
#include <vector>

#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/imperfect_maps/interleaved_light.h"
#include "renderer/imperfect_maps/rest_maps.h"
#include "renderer/methods/gi_method.h"
#include "renderer/methods/imperfect_light/parameters.h"
#include "renderer/surface_light/pixels/pixel_reflectance.h"

namespace lamplighter {

// By pixel of the current G-buffer, row by row: reflected share of uniform light towards the eye,
// divided by π.
std::vector<vec3> reflectancesOf(const FrameInputs& in, const SurfacePictureOptions& options);

class ExactSum {
 public:
  // Inputs that must not change until restart().
  struct Subject {
    const ImperfectParameters& parameters;
    SurfacePictureOptions pixels;
    int antialias = 1;                 // shifted pictures, at least 1
    OccluderPool pool;                 // for imperfect maps
    std::span<const SceneVpl> direct;  // light samples on the lights, for bias compensation
  };

  void restart();
  // Call when objects moved, were added or removed, or changed their transparency.
  void outdateMaps() { maps_.outdate(); }
  // The samples to be summed, and the same with their clamp distances. restart() keeps them.
  void setLights(std::vector<SceneVpl> samples, std::vector<MapLight> lights);
  void dropLights() { hasLights_ = false; }
  bool hasLights() const { return hasLights_; }

  // Goes on for a frame: some lights at all pixels of all shifted pictures; when there are all,
  // some rows of the light that the clamp of 1/d² removes near surfaces. Requires hasLights().
  // Returns the rays of shadow maps. `gbufferIsCurrent`: set to whether the backend has the
  // G-buffer of the view without a shift.
  uint64_t goOn(const FrameInputs& in, const Subject& subject, bool& gbufferIsCurrent);
  bool isDone() const { return isDone_; }
  // Estimate of the frames until isDone(), with `lights` samples if there are none yet.
  int framesLeft(const View& view, const ImperfectParameters& parameters, int antialias,
                 size_t lights) const;
  // If isDone(): that the samples give to each pixel [W/(m² sr)].
  const Image& radiance() const { return sum_; }

 private:
  uint64_t addLightsOf(const FrameInputs& in, const Subject& subject, bool& gbufferIsCurrent);
  void addCompensation(const FrameInputs& in, const Subject& subject);

  bool hasLights_ = false, isDone_ = false;
  std::vector<SceneVpl> samples_;
  std::vector<MapLight> lights_;
  RestMaps maps_;
  std::vector<Image> irradiance_;  // of each shifted picture, by the first `summed_` lights
  size_t summed_ = 0;
  Image sum_;
  int compensationRow_ = 0;  // rows that are compensated
  std::vector<BiasCompensation::Pixel> compensation_;
};

}  // namespace lamplighter
