// Early batches of a refinement have few rays a pixel for the light that the clamp takes away, and
// show it as speckles, in the colour of what reflects it twice. It varies little along a surface,
// so that pixels share what they find, over fewer and fewer pixels the more batches there are: what
// that blurs vanishes in the mean.
#pragma once

#include <span>

#include "renderer/image/image.h"
#include "renderer/methods/many_lights/bias_compensation.h"

namespace lamplighter {

// Pixels to each side that the batch (from 1) shares with in a picture of so many rows; 0 from the
// 37th on, and in the smallest pictures.
int filterRadius(uint32_t batch, int height);

// Adds to the picture the mean of what pixels within `radius` to each side have found that show the
// same surface (nearly in its plane, nearly the same normal), times each pixel's own albedo.
void addSmoothed(std::span<const BiasCompensation::Pixel> pixels, int radius, Image& image);

}  // namespace lamplighter
