// Lobes of the reference: directions are sampled with the density that is claimed.
#include "renderer/methods/path_tracer/glossy_surface.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"

namespace lamplighter {
namespace {

// No reflection is much brighter than what it shows, however flat the eye looks at the surface.
TEST(GlossySurfaces, WeightsOfDirectionsAreBounded) {
  const vec3 normal(0, 0, 1);
  for (const LobeArithmetic arithmetic : {LobeArithmetic::fromCosine, LobeArithmetic::fromSine})
    for (const float roughness : {0.1f, 0.3f, 1.0f})
      for (const float metallic : {0.0f, 1.0f})
        for (const float cosine : {1e-5f, 1e-3f, 0.009f, 0.02f, 0.3f, 1.0f}) {
          const vec3 eye(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
          const GlossySurface surface(vec3(0.8f), {metallic, roughness}, 0.1f, normal, eye,
                                      arithmetic);
          float most = 0.0f;
          for (uint32_t k = 0; k < 1 << 15; ++k) {
            const vec3 w = surface.sample(sobol2(k, 1).x, sobol2(k, 2));
            const float pdf = surface.pdf(w);
            if (w.z > 0.0f && pdf > 0.0f) most = std::max(most, surface.brdf(w).x * w.z / pdf);
          }
          EXPECT_LT(most, 2.5f) << roughness << " " << metallic << " " << cosine;
          EXPECT_GT(most, 0.2f);
        }
}

}  // namespace
}  // namespace lamplighter
