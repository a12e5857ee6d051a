// Accessibility of a surface point: the share of the light of a uniform sky that reaches it if only
// surfaces nearer than a radius block it (Zhukov, Iones and Kronin, "An Ambient Light Illumination
// Model", 1998, where it is called obscurance):
//
//   A = 1/π ∫ ρ(d(ω)) cos θ dω,
//
// with d the distance of the first surface in direction ω. ρ grows from 0 at a distance of 0 to 1
// at the radius.
#pragma once

#include "renderer/methods/common_parameters.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

enum class Falloff : uint8_t {
  none,    // ρ = 0: every surface within the radius blocks all light (ambient occlusion)
  linear,  // ρ = d / radius
  root  // ρ = √(d / radius) (Méndez, Sbert and Catà, "Real-time Obscurances with Color Bleeding",
        // 2003)
};

struct AccessibilityOptions : SeedParameters {
  float radius = 1.0f;  // [m]
  Falloff falloff = Falloff::root;
  bool operator==(const AccessibilityOptions&) const = default;
};

// One ray of an estimate: ρ along a cosine-weighted direction, in [0, 1]. The mean over the samples
// of a pixel converges to A. Unit normals on the same side; directions below the triangle are
// mirrored to its front, so that smooth shading does not darken convex surfaces. Depends only on
// the scene and the arguments.
float sampleAccessibility(const RayCaster& rays, const vec3& position, const vec3& normal,
                          const vec3& geometricNormal, uint32_t pixel, uint32_t sample,
                          const AccessibilityOptions& options);

}  // namespace lamplighter
