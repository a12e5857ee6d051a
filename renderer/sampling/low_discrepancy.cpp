#include "renderer/sampling/low_discrepancy.h"

#include "renderer/sampling/random.h"

namespace lamplighter {

namespace {

uint32_t reverseBits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

// Owen scrambling as a hash in which every bit depends on the lower bits only, on reversed bits;
// the permutation of Laine and Karras with the constants found by N. Vegdahl (2021).
uint32_t owenScramble(uint32_t x, uint32_t seed) {
  x = reverseBits(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reverseBits(x);
}

// The second Sobol dimension: generator matrix of the primitive polynomial x + 1, column by column
// v ^= v >> 1.
uint32_t sobolSecond(uint32_t index) {
  uint32_t result = 0;
  for (uint32_t v = 0x80000000u; index != 0; index >>= 1, v ^= v >> 1) {
    if (index & 1u) result ^= v;
  }
  return result;
}

}  // namespace

vec2 sobol2Ordered(uint32_t index, uint32_t scramble) {
  const uint32_t x = owenScramble(reverseBits(index), hash4(scramble, 1u, 0u, 0u));
  const uint32_t y = owenScramble(sobolSecond(index), hash4(scramble, 2u, 0u, 0u));
  return {toUnitFloat(x), toUnitFloat(y)};
}

vec2 sobol2(uint32_t index, uint32_t scramble) {
  return sobol2Ordered(owenScramble(index, hash4(scramble, 3u, 0u, 0u)), scramble);
}

vec2 PathSampler::next2() {
  return sobol2(sample_, hash4(pixel_, dimension_++, seed_, 0x9e3779b9u));
}

}  // namespace lamplighter
