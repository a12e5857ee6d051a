// Skies for tests.
#pragma once

#include <filesystem>

#include "renderer/scene/sky.h"

namespace lamplighter::test {

// Blue above, bright at the horizon, brown below. No part is grey.
Sky gradientSky();
// A picture of 64 × 32 pixels with soft clouds and no sun.
Sky cloudySky();
// A picture of 720 × 360 pixels: a dim blue upper half, a dark lower half, and a sun of 1°
// diameter. The irradiance of the sun, perpendicular to its direction, is about twice that of the
// rest of the sky. Its centre is 40° above the horizon towards +X.
Sky sunnySky();

// The irradiance of the sky on a plane with the normal `normal`, which sees half of the sky, by
// quadrature.
vec3 irradianceOn(const Sky& sky, const vec3& normal);
// ∫ L dω over the whole sky, by quadrature.
vec3 irradianceOfAll(const Sky& sky);

// Writes the pixels as an EXR file and reads them back as a sky picture with a file.
std::shared_ptr<const SkyImage> throughFile(const Image& pixels, const std::filesystem::path& file);

}  // namespace lamplighter::test
