// Two estimates that share no random numbers: a signal that both have in common is not noise.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/base/math.h"

namespace lamplighter {

struct Halves {
  vec3 first{0.0f}, second{0.0f};
  vec3 mean() const { return 0.5f * (first + second); }
  vec3 half() const { return 0.5f * (first - second); }
};

// Statistical test over many pixels: whether the halves differ from zero by a common signal or by
// noise.
class Evidence {
 public:
  // `independence`: number of statistically independent pixels that this one counts as.
  void add(const Halves& h, float independence = 1.0f) {
    const float mean = glm::dot(h.mean(), h.mean()), half = glm::dot(h.half(), h.half());
    if (!(mean + half > 0.0f)) return;
    agreement_ += static_cast<double>((mean - half) / (mean + half));
    pixels_ += 1.0;
    independent_ += static_cast<double>(independence);
  }
  // 0: noise, or undecided. 1: common signal in all pixels.
  float share() const {
    constexpr double kSure = 2.0;  // standard deviations of the agreement of noise by chance
    if (!(independent_ > 0.0)) return 0.0f;
    const double mean = agreement_ / pixels_;
    const double chance = kSure * (1.0 - mean) / std::sqrt(independent_);
    return static_cast<float>(std::clamp(mean - chance, 0.0, 1.0));
  }

 private:
  double agreement_ = 0.0, pixels_ = 0.0, independent_ = 0.0;
};

}  // namespace lamplighter
