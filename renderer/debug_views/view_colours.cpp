#include "renderer/debug_views/view_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamplighter::view_colours {

vec3 ramp(float t) {
  static constexpr std::array kStops = {vec3(0.17f, 0.22f, 0.45f), vec3(0.13f, 0.50f, 0.62f),
                                        vec3(0.42f, 0.72f, 0.36f), vec3(0.96f, 0.80f, 0.26f),
                                        vec3(0.86f, 0.27f, 0.20f)};
  const float at = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(kStops.size() - 1);
  const auto low = std::min(static_cast<size_t>(at), kStops.size() - 2);
  return glm::mix(kStops[low], kStops[low + 1], at - static_cast<float>(low));
}

std::vector<vec3> rampSteps(float from) {
  constexpr int kSteps = 33;
  std::vector<vec3> steps;
  for (int i = 0; i < kSteps; ++i)
    steps.push_back(ramp(glm::mix(from, 1.0f, static_cast<float>(i) / (kSteps - 1))));
  return steps;
}

vec3 ofPatch(uint32_t object, int patch) {
  // Steps of the golden ratio distribute hues evenly for any number of them.
  const double turn = 0.6180339887 * patch + 0.2360679775 * object;
  const auto hue = static_cast<float>(6.0 * (turn - std::floor(turn)));
  const float saturation = 0.26f + 0.10f * static_cast<float>(patch % 3);
  const float value = 0.95f - 0.13f * static_cast<float>((patch / 3) % 3);
  const vec3 pure = glm::clamp(
      vec3(std::abs(hue - 3.0f) - 1.0f, 2.0f - std::abs(hue - 2.0f), 2.0f - std::abs(hue - 4.0f)),
      0.0f, 1.0f);
  return value * glm::mix(vec3(1.0f), pure, saturation);
}

int niceMaximum(int value) {
  int power = 1;
  while (true) {
    for (const int digit : {1, 2, 5})
      if (digit * power >= value) return digit * power;
    power *= 10;
  }
}

}  // namespace lamplighter::view_colours
