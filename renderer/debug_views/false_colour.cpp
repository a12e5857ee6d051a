// Illuminance and luminance as colours, on a logarithmic scale, like human vision.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"

namespace lamplighter::views {

namespace colours = view_colours;

namespace {

constexpr float kDecades = 3.0f;  // default range

// The smallest of 1, 2, 5 times a power of ten that is not less than `value`.
float niceAbove(float value) {
  const float power = std::pow(10.0f, std::floor(std::log10(value)));
  for (const float digit : {1.0f, 2.0f, 5.0f})
    if (digit * power >= 0.999f * value) return digit * power;
  return 10.0f * power;
}

// The upper end is above almost all pixels, so that a visible lamp does not compress the other
// colours.
std::pair<float, float> rangeOf(const FalseColour& asked, std::vector<float> values) {
  if (asked.high > asked.low && asked.low > 0.0f) return {asked.low, asked.high};
  std::erase_if(values, [](float v) { return !(v > 0.0f) || !std::isfinite(v); });
  if (values.empty()) return {0.001f, 1.0f};
  const size_t at = values.size() * 99 / 100;
  std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(at), values.end());
  const float high = niceAbove(values[at]);
  return {high / std::pow(10.0f, kDecades), high};
}

std::string textOf(float value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 1e5f && value >= 0.999e-3f ? "%.4g" : "%.0e",
                static_cast<double>(value));
  return text;
}

Legend legendOf(const FalseColour& what, float low, float high) {
  Legend legend;
  legend.title = what.isLux ? "Illuminance [lx]" : "Luminance [nt = cd/m\u00b2]";
  legend.ramp = colours::rampSteps();
  const float decades = std::log10(high / low);
  // Number of ramp steps with round labels: 4, or one per decade if they fit.
  const int steps =
      decades > 0.99f && decades < 4.01f && std::abs(decades - std::round(decades)) < 0.01f
          ? static_cast<int>(std::lround(decades))
          : 3;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    legend.ticks.emplace_back(t, textOf(low * std::pow(high / low, t)));
  }
  if (what.isLux) legend.swatches = {{colours::kNoData, "lamps"}};
  return legend;
}

vec3 colourOf(float value, float low, float high) {
  if (!(value > 0.0f)) return colours::ramp(0.0f);
  return colours::ramp(std::log(value / low) / std::log(high / low));
}

}  // namespace

ViewPicture falseColour(const ViewSubject& in) {
  const Image& radiance = *in.radiance;
  const FalseColour& what = in.falseColour;
  const Painter p(in);
  // E = π L of a white surface. Emission is excluded, because it is not incident light.
  std::vector<float> values(p.pixels(), 0.0f);
  p.forEachPixel([&](int x, int y, size_t i) {
    const float l = luminance(radiance.at(x, y));
    if (!what.isLux)
      values[i] = l;
    else if (p.hit(i) && p.seen(i).surface.emission == vec3(0.0f))
      values[i] = kPi * l;
  });
  const auto [low, high] = rangeOf(what, values);
  ViewPicture out;
  if (what.isLux) {
    out.image = p.paint([&, low = low, high = high](const Seen& s, size_t i) {
      return s.surface.emission == vec3(0.0f) ? colourOf(values[i], low, high) : colours::kNoData;
    });
  } else {
    out.image = Image8(in.view.width, in.view.height);  // the sky also has luminance
    p.forEachPixel([&, low = low, high = high](int x, int y, size_t i) {
      const vec3 c = colourOf(values[i], low, high);
      for (int k = 0; k < 3; ++k)
        out.image.at(x, y)[k] = static_cast<uint8_t>(c[k] * 255.0f + 0.5f);
    });
  }
  out.legend = legendOf(what, low, high);
  return out;
}

}  // namespace lamplighter::views
