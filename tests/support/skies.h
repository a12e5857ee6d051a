// Skies for tests.
#pragma once

#include <filesystem>

#include "renderer/scene/sky.h"

namespace lamplighter::test {

// Blue above, bright at the horizon, brown below: nothing of it grey.
Sky gradientSky();
// A picture of 64 × 32 pixels of soft clouds without a sun.
Sky cloudySky();
// A picture of 720 × 360 pixels: a dim blue upper half, a dark lower one, and a sun of 1° whose
// irradiance across its direction is about twice the whole rest's; its middle is 40° high towards
// +X.
Sky sunnySky();

// The irradiance of a sky on a plane that faces `normal` and sees half of it, by quadrature.
vec3 irradianceOn(const Sky& sky, const vec3& normal);
// ∫ L dω, likewise.
vec3 irradianceOfAll(const Sky& sky);

// Writes the pixels as an EXR and reads them back as a sky's picture that has a file.
std::shared_ptr<const SkyImage> throughFile(const Image& pixels, const std::filesystem::path& file);

}  // namespace lamplighter::test
