#include "renderer/base/low_discrepancy.h"

#include "renderer/base/random.h"

namespace lamplighter {

namespace {

inline uint32_t reverseBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

// Owen scrambling as a hash on reversed bits, in which every bit depends only on the lower bits:
// the permutation of Laine and Karras with the constants by N. Vegdahl (2021). Takes the reversed
// bits and returns the number.
inline uint32_t owenScrambleReversed(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverseBits(x);
}

inline uint32_t owenScramble(uint32_t x, uint32_t seed) {
  return owenScrambleReversed(reverseBits(x), seed);
}

// The second Sobol dimension, with reversed bits. Column k of its generator matrix (primitive
// polynomial x + 1) has bit j set if the binomial coefficient (k over j) is odd, that is, if the
// bits of j are a subset of those of k (Lucas). So bit j is the sum of the index's bits k with that
// property. It is computed in log steps, one per binary digit of the bit positions.
inline uint32_t sobolSecondReversed(uint32_t index) {
  index ^= index >> 1 & 0x55555555u;
  index ^= index >> 2 & 0x33333333u;
  index ^= index >> 4 & 0x0f0f0f0fu;
  index ^= index >> 8 & 0x00ff00ffu;
  index ^= index >> 16 & 0x0000ffffu;
  return index;
}

// The first dimension is the index with its bits reversed.
inline float sobolFirst(uint32_t index, uint32_t scramble) {
  return toUnitFloat(owenScrambleReversed(index, hash4(scramble, 1u, 0u, 0u)));
}

inline float sobolSecond(uint32_t index, uint32_t scramble) {
  return toUnitFloat(owenScrambleReversed(sobolSecondReversed(index), hash4(scramble, 2u, 0u, 0u)));
}

inline uint32_t shuffled(uint32_t index, uint32_t scramble) {
  return owenScramble(index, hash4(scramble, 3u, 0u, 0u));
}

}  // namespace

vec2 sobol2Ordered(uint32_t index, uint32_t scramble) {
  return {sobolFirst(index, scramble), sobolSecond(index, scramble)};
}

vec2 sobol2(uint32_t index, uint32_t scramble) {
  return sobol2Ordered(shuffled(index, scramble), scramble);
}

uint32_t PathSampler::nextScramble() { return hash4(pixel_, dimension_++, seed_, 0x9e3779b9u); }

vec2 PathSampler::next2() { return sobol2(sample_, nextScramble()); }

float PathSampler::next1() {
  const uint32_t scramble = nextScramble();
  return sobolFirst(shuffled(sample_, scramble), scramble);
}

}  // namespace lamplighter
