#include "renderer/image/exposure.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

float autoExposureEv(const Image& radiance) {
  std::vector<float> luminance;
  luminance.reserve(radiance.pixels.size());
  for (const vec3& p : radiance.pixels) {
    const float y = glm::dot(p, vec3(0.2126f, 0.7152f, 0.0722f));
    if (y > 0.0f && std::isfinite(y)) luminance.push_back(y);
  }
  if (luminance.empty()) return 0.0f;
  const size_t kept = std::max<size_t>(1, luminance.size() * 98 / 100);
  std::nth_element(luminance.begin(), luminance.begin() + static_cast<std::ptrdiff_t>(kept - 1),
                   luminance.end());
  luminance.resize(kept);
  std::sort(luminance.begin(), luminance.end());  // the sum's order is then the same everywhere
  double sum = 0.0;
  for (const float y : luminance) sum += std::log2(static_cast<double>(y));
  const double ev = std::log2(0.18) - sum / static_cast<double>(kept);
  return std::clamp(static_cast<float>(std::round(4.0 * ev) / 4.0), -16.0f, 16.0f);
}

}  // namespace lamplighter
