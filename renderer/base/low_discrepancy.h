// Low-discrepancy points, stateless: a function of index and scramble.
#pragma once

#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

// The first two dimensions of the Sobol sequence at `index`, shuffled and Owen-scrambled by hashes
// of `scramble` (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020). In [0, 1)². Any
// aligned power of two of consecutive indices is a (0, 2)-net; prefixes of a sequence are stable.
vec2 sobol2(uint32_t index, uint32_t scramble);

// The same without the shuffle of indices: neighbouring counts share their first points, so that a
// set that grows keeps what it had.
vec2 sobol2Ordered(uint32_t index, uint32_t scramble);

// Random numbers of one path: dimensions drawn one after the other, each its own scrambled sequence
// over the samples of the pixel (padding), a function of (pixel, sample, dimension, seed) alone.
class PathSampler {
 public:
  PathSampler(uint32_t pixel, uint32_t sample, uint32_t seed)
      : pixel_(pixel), sample_(sample), seed_(seed) {}
  vec2 next2();
  float next1() { return next2().x; }

 private:
  uint32_t pixel_, sample_, seed_, dimension_ = 0;
};

}  // namespace lamplighter
