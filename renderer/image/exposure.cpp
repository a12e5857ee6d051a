#include "renderer/image/exposure.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

float autoExposureEv(const Image& radiance) {
  std::vector<float> values;  // luminances
  values.reserve(radiance.pixels.size());
  for (const vec3& p : radiance.pixels) {
    const float y = luminance(p);
    if (y > 0.0f && std::isfinite(y)) values.push_back(y);
  }
  if (values.empty()) return 0.0f;
  const size_t kept = std::max<size_t>(1, values.size() * 98 / 100);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1),
                   values.end());
  values.resize(kept);
  std::sort(values.begin(), values.end());  // makes the order of the sum the same everywhere
  double sum = 0.0;
  for (const float y : values) sum += std::log2(static_cast<double>(y));
  const double middle = std::log2(0.18) - sum / static_cast<double>(kept);
  const double bright = -std::log2(static_cast<double>(values[(kept - 1) * 85 / 100]));
  const double ev = std::min(middle, bright);
  return std::clamp(static_cast<float>(std::round(4.0 * ev) / 4.0), -16.0f, 16.0f);
}

}  // namespace lamplighter
