#include "editor/lights/colour_temperature.h"

#include <algorithm>
#include <vector>

namespace lamplighter {

namespace {

// CIE XYZ to linear Rec. 709, white point D65 (ITU-R BT.709-6; columns are X, Y, Z).
const mat3 kRec709FromXyz(3.2404542f, -0.9692660f, 0.0556434f,   // X
                          -1.5371385f, 1.8760108f, -0.2040259f,  // Y
                          -0.4985314f, 0.0415560f, 1.0572252f);  // Z

vec2 uvOf(const vec3& rgb) {
  static const mat3 kXyzFromRec709 = glm::inverse(kRec709FromXyz);
  const vec3 xyz = kXyzFromRec709 * rgb;
  const float sum = xyz.x + 15.0f * xyz.y + 3.0f * xyz.z;
  return vec2(4.0f * xyz.x, 6.0f * xyz.y) / sum;
}

vec2 locusAt(double mired) { return uvOf(planckianColour(static_cast<float>(1e6 / mired))); }

// Uniform steps in mired are nearly uniform steps along the curve.
constexpr double kFirst = 1e6 / kMostKelvin, kLast = 1e6 / kLeastKelvin, kStep = 4.0;

// The points of the curve at these steps.
const std::vector<vec2>& locus() {
  static const std::vector<vec2> kLocus = [] {
    std::vector<vec2> points;
    for (double mired = kFirst; mired <= kLast; mired += kStep) points.push_back(locusAt(mired));
    return points;
  }();
  return kLocus;
}

}  // namespace

vec3 planckianColour(float kelvin) {
  const double t = std::clamp(kelvin, kLeastKelvin, kMostKelvin);
  const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                   (1.0 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
  const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                   (1.0 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
  const double d = 2.0 * u - 8.0 * v + 4.0;
  const double x = 3.0 * u / d, y = 2.0 * v / d;
  const vec3 xyz(static_cast<float>(x / y), 1.0f, static_cast<float>((1.0 - x - y) / y));
  const vec3 rgb = glm::max(kRec709FromXyz * xyz, vec3(0.0f));
  return rgb / luminance(rgb);
}

std::optional<float> temperatureOf(const vec3& colour) {
  if (!(luminance(colour) > 0.0f)) return std::nullopt;
  const vec2 uv = uvOf(colour / luminance(colour));
  const auto nearer = [&](const vec2& a, const vec2& b) {
    return glm::distance(a, uv) < glm::distance(b, uv);
  };
  const auto nearest = std::min_element(locus().begin(), locus().end(), nearer);
  const double best = kFirst + kStep * static_cast<double>(nearest - locus().begin());
  double low = std::max(best - kStep, kFirst), high = std::min(best + kStep, kLast);
  const auto distanceTo = [&](double mired) { return glm::distance(locusAt(mired), uv); };
  for (int i = 0; i < 40; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (distanceTo(a) <= distanceTo(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  const double mired = 0.5 * (low + high);
  constexpr float kFarthest = 0.0054f;
  if (distanceTo(mired) > kFarthest) return std::nullopt;
  return static_cast<float>(1e6 / mired);
}

vec3 withTemperature(const vec3& colour, float kelvin) {
  return luminance(colour) * planckianColour(kelvin);
}

}  // namespace lamplighter
