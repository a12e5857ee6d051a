// Sums of paths by pixel, in two halves that share no random numbers, and their variance.
#pragma once

#include <algorithm>
#include <vector>

#include "renderer/image/image.h"

namespace lamplighter {

class PathSums {
 public:
  // Number of consecutive paths of a half that are stratified together: the variance is estimated
  // from the means of such groups.
  static constexpr int kGroup = 4;

  PathSums() = default;
  PathSums(int width, int height)
      : first(width, height),
        second(width, height),
        squares_(first.pixels.size(), 0.0f),
        groups_{first, second} {}

  // One path of each pixel of a half; several threads may add different pixels.
  void add(bool isFirst, size_t pixel, const vec3& radiance) {
    (isFirst ? first : second).pixels[pixel] += radiance;
    vec3& group = groups_[isFirst ? 0 : 1].pixels[pixel];
    group += radiance;
    if ((paths / 2 + 1) % kGroup != 0) return;
    squares_[pixel] += glm::dot(group, group);
    group = vec3(0.0f);
  }
  // Call after each pixel got a path in one half; call it twice if each got one in both.
  void endPath() {
    ++paths;
    weight += 1.0f;
    if (paths % (2 * kGroup) == 0) groups += 2.0f;
  }
  // Mean square difference between paths, over the picture. Both halves must have the same number
  // of paths.
  double noise() const {
    double sum = 0.0;
    for (size_t i = 0; i < squares_.size(); ++i) {
      const vec3 difference = first.pixels[i] - second.pixels[i];
      sum += static_cast<double>(glm::dot(difference, difference));
    }
    return paths > 0 ? sum / static_cast<double>(paths) : 0.0;
  }

  // Subtracts a value from each path of a pixel. All groups must be complete.
  void subtract(const Image& taken) {
    const float halfPaths = 0.5f * weight;
    for (size_t i = 0; i < squares_.size(); ++i) {
      const vec3 t = taken.pixels[i], sum = first.pixels[i] + second.pixels[i];
      const float square = weight * glm::dot(t, t) - 2.0f * glm::dot(t, sum);
      squares_[i] += static_cast<float>(kGroup) * square;
      first.pixels[i] -= halfPaths * t;
      second.pixels[i] -= halfPaths * t;
    }
  }
  // Multiplies the weight of every path.
  void scale(float factor) {
    for (size_t i = 0; i < squares_.size(); ++i) {
      first.pixels[i] *= factor;
      second.pixels[i] *= factor;
      squares_[i] *= factor;
    }
    weight *= factor;
    groups *= factor;
  }
  // Adds the paths of another. All groups of this must be complete.
  void add(const PathSums& other) {
    for (size_t i = 0; i < squares_.size(); ++i) {
      first.pixels[i] += other.first.pixels[i];
      second.pixels[i] += other.second.pixels[i];
      squares_[i] += other.squares_[i];
      for (int half = 0; half < 2; ++half) groups_[half].pixels[i] = other.groups_[half].pixels[i];
    }
    paths += other.paths;
    weight += other.weight;
    groups += other.groups;
  }
  bool knowsVariance() const { return groups >= 4.0f; }
  // Variance of the mean of all paths of a pixel, summed over the channels, from complete groups.
  float variance(size_t pixel) const {
    const float n = groups;
    constexpr auto size = static_cast<float>(kGroup);
    const vec3 sum = first.pixels[pixel] + second.pixels[pixel] - groups_[0].pixels[pixel] -
                     groups_[1].pixels[pixel];
    const vec3 mean = sum / (n * size);
    const float square = squares_[pixel] / (n * size * size);
    const float ofGroup = std::max(square - glm::dot(mean, mean), 0.0f) * n / (n - 1.0f);
    return ofGroup * size / weight;
  }

  Image first, second;  // sums of each half
  int paths = 0;
  float weight = 0.0f;  // weight of all paths: their number, unless scaled
  float groups = 0.0f;  // weight of the complete groups

 private:
  std::vector<float> squares_;  // by pixel: squares of the sums of groups
  Image groups_[2];             // by half: sums of incomplete groups
};

}  // namespace lamplighter
