// Stateless low-discrepancy points: functions of index and scramble.
#pragma once

#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

// The first two dimensions of the Sobol sequence at `index`, shuffled and Owen-scrambled by hashes
// of `scramble` (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). In [0, 1)². Any
// aligned power of two of consecutive indices is a (0, 2)-net; prefixes of a sequence are stable.
vec2 sobol2(uint32_t index, uint32_t scramble);

// The same without shuffling the indices: sets of different size share their first points, so a set
// that grows keeps its points.
vec2 sobol2Ordered(uint32_t index, uint32_t scramble);

// Random numbers of one path. Each dimension is a scrambled sequence of its own over the samples of
// the pixel (padding); dimensions are drawn in order. The numbers depend only on (pixel,
// sample, dimension, seed).
class PathSampler {
 public:
  PathSampler(uint32_t pixel, uint32_t sample, uint32_t seed)
      : pixel_(pixel), sample_(sample), seed_(seed) {}
  vec2 next2();
  float next1();  // the first number of next2()
  // Skips a dimension that is not needed, so that later ones do not change.
  void skip() { ++dimension_; }

 private:
  uint32_t nextScramble();

  uint32_t pixel_, sample_, seed_, dimension_ = 0;
};

}  // namespace lamplighter
