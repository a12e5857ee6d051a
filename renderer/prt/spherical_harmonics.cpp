#include "renderer/prt/spherical_harmonics.h"

namespace lamplighter {

// The polynomials in Cartesian form; the constants have more digits than a float.
ShVector shBasis(const vec3& d) {
  const float x = d.x, y = d.y, z = d.z;
  const float x2 = x * x, y2 = y * y, z2 = z * z;
  return {0.28209479177f,

          0.48860251190f * y,
          0.48860251190f * z,
          0.48860251190f * x,

          1.09254843059f * x * y,
          1.09254843059f * y * z,
          0.31539156525f * (3.0f * z2 - 1.0f),
          1.09254843059f * x * z,
          0.54627421529f * (x2 - y2),

          0.59004358992f * y * (3.0f * x2 - y2),
          2.89061144264f * x * y * z,
          0.45704579946f * y * (5.0f * z2 - 1.0f),
          0.37317633259f * z * (5.0f * z2 - 3.0f),
          0.45704579946f * x * (5.0f * z2 - 1.0f),
          1.44530572132f * z * (x2 - y2),
          0.59004358992f * x * (x2 - 3.0f * y2),

          2.50334294179f * x * y * (x2 - y2),
          1.77013076978f * y * z * (3.0f * x2 - y2),
          0.94617469576f * x * y * (7.0f * z2 - 1.0f),
          0.66904654355f * y * z * (7.0f * z2 - 3.0f),
          0.10578554692f * (z2 * (35.0f * z2 - 30.0f) + 3.0f),
          0.66904654355f * x * z * (7.0f * z2 - 3.0f),
          0.47308734788f * (x2 - y2) * (7.0f * z2 - 1.0f),
          1.77013076978f * x * z * (x2 - 3.0f * y2),
          0.62583573545f * (x2 * (x2 - 3.0f * y2) - y2 * (3.0f * x2 - y2))};
}

ShVector cosineTransfer(const vec3& normal) {
  ShVector out = shBasis(normal);
  for (int band = 0; band < kShBands; ++band)
    for (int order = -band; order <= band; ++order)
      out[static_cast<size_t>(shIndex(band, order))] *= kCosineFactors[static_cast<size_t>(band)];
  return out;
}

float shDot(const ShVector& a, const ShVector& b) {
  float sum = 0.0f;
  for (size_t i = 0; i < kShCoefficients; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace lamplighter
