// Measures the brightness at a pixel: the light that the surface receives, and the light that it
// sends to the camera.
#pragma once

#include <optional>
#include <string>

#include "editor/explain/explanation.h"
#include "renderer/image/image.h"

namespace lamplighter {

struct Reading {
  vec2 pixel{0.0f};
  std::string object;         // "sky" if the ray hits nothing
  std::optional<float> lux;   // irradiance; none if the ray hits nothing
  std::optional<float> nits;  // radiance towards the camera; none while another picture is shown
  std::optional<float> distance;  // from the camera [m]
};

// `picture`: the radiance of the lit picture; null while another picture is shown.
Reading probe(const Scene& scene, const RenderScene& world, const RayCaster& rays, const View& view,
              const vec2& pixel, const LightSamples& samples, const Image* picture);

// "floor: 123 lx, 45.6 nt, 3.210 m away"
std::string readingText(const Reading& reading);

}  // namespace lamplighter
