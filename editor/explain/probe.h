// How bright a place is: the light that falls on it, and the light that comes from it to the
// camera.
#pragma once

#include <optional>
#include <string>

#include "editor/explain/explanation.h"
#include "renderer/image/image.h"

namespace lamplighter {

struct Reading {
  vec2 pixel{0.0f};
  std::string object;             // "sky" where nothing is hit
  std::optional<float> lux;       // irradiance; none where nothing is hit
  std::optional<float> nits;      // radiance towards the camera; none while the picture is another
  std::optional<float> distance;  // from the camera [m]
};

// `picture`: the radiance of the lit picture, null while another is shown.
Reading probe(const Scene& scene, const RenderScene& world, const RayCaster& rays, const View& view,
              const vec2& pixel, const LightSamples& samples, const Image* picture);

// "floor: 123 lx, 45.6 nt, 3.210 m away"
std::string readingText(const Reading& reading);

}  // namespace lamplighter
