// The first batches of a refinement have few rays per pixel for the light that the clamp removes,
// which causes coloured speckles. This light varies slowly along a surface, so pixels share their
// results. The filter radius shrinks with each batch, so the blur disappears from the mean.
#pragma once

#include <span>

#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/image/image.h"

namespace lamplighter {

// Filter radius in pixels for batch number `batch` (from 1) of a picture with `height` rows; 0 from
// the 37th batch, and in very small pictures.
int filterRadius(uint32_t batch, int height);

// Adds to each pixel of the picture: the mean of the results of pixels within `radius` to each side
// that show the same surface (almost the same plane and normal), times the pixel's own albedo.
void addSmoothed(std::span<const BiasCompensation::Pixel> pixels, int radius, Image& image);

}  // namespace lamplighter
