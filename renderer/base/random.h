// Stateless random numbers: functions of seed, pixel, sample and dimension. The result does not
// depend on the order of threads.
#pragma once

#include <cstdint>

#include "renderer/base/math.h"

namespace lamplighter {

// A 32-bit hash of four words with full avalanche: the first word of PCG4D (Jarzynski and Olano,
// "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
inline uint32_t hash4(uint32_t x, uint32_t y, uint32_t z, uint32_t w) {
  x = x * 1664525u + 1013904223u;
  y = y * 1664525u + 1013904223u;
  z = z * 1664525u + 1013904223u;
  w = w * 1664525u + 1013904223u;
  x += y * w;
  y += z * x;
  z += x * y;
  w += y * z;
  x ^= x >> 16;
  y ^= y >> 16;
  z ^= z >> 16;
  w ^= w >> 16;
  x += y * w;
  y += z * x;
  z += x * y;
  w += y * z;
  return x;
}

// Uniform in [0, 1), 24 bits.
inline float toUnitFloat(uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

// For low-discrepancy points see low_discrepancy.h.

// Maps the unit square to the unit disk with little distortion (Shirley and Chiu 1997).
vec2 sampleDisk(vec2 u);
// A direction in the hemisphere around +Z with density cos θ/π.
vec3 sampleCosineHemisphere(vec2 u);
// A direction on the sphere with density 1/4π.
vec3 sampleSphere(vec2 u);

// A half vector of a GGX lobe that is visible from the eye (E. Heitz, "Sampling the GGX
// Distribution of Visible Normals", JCGT 7(4), 2018): stretches the lobe to a hemisphere and
// samples its projected disc. Both in the frame of the normal (+Z). `alpha`: square of the
// roughness.
vec3 sampleVisibleNormal(const vec3& eye, float alpha, vec2 u);

}  // namespace lamplighter
