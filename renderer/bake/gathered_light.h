// Bounced light at any point of the surface: texels of all surfaces exchange light, and the last
// bounce is gathered from them at the point (paper 3, section 4.3: final gathering), without
// interpolation between points.
#pragma once

#include <array>
#include <vector>

#include "renderer/bake/direct_light.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

class GatheredLight {
 public:
  // Computes the light of the texels. Keeps references to the scene and the rays. Uses the options
  // of texels, links and bounces.
  GatheredLight(const RenderScene& scene, const RayCaster& rays, const DirectLight& direct,
                const TexelRadiosityOptions& options);

  // Irradiance on the front of a triangle of an object [W/m²]. Thread-safe.
  vec3 irradiance(uint32_t object, uint32_t triangle, const ReceivingPlace& at) const;
  // Side of the texels, within the memory limit [m].
  float side() const { return side_; }

 private:
  // The centres of the quarters of a texel.
  struct Quarters {
    std::array<vec3, 4> at;
    std::array<bool, 4> isOpen{};  // on the surface, and not inside an object
    float share = 0.0f;            // share of open quarters among those on the surface
    // One of the open quarters, if there is any.
    const vec3& any(uint32_t number) const {
      for (uint32_t k = 0; k < 4; ++k)
        if (isOpen[(number + k) % 4]) return at[(number + k) % 4];
      return at[0];
    }
  };
  std::vector<vec3> findPoints(const DirectLight& direct);
  void fillClosed();
  void bounce(const std::vector<vec3>& direct);
  uint32_t texelAt(uint32_t object, uint32_t triangle, const vec3& position) const;
  vec3 gathered(const SurfaceSpot& spot, uint32_t texel) const;
  // Sums over the texels that a spot sees.
  struct Sum {
    vec3 light{0.0f};      // [W/m²]
    float weights = 0.0f;  // shares of the light that arrives
    void add(float weight, const vec3& reflected) {
      light += weight * reflected;
      weights += weight;
    }
  };
  void addTexel(const SurfaceSpot& spot, uint32_t texel, float factor, Sum& sum) const;
  void addQuarter(const SurfaceSpot& spot, uint32_t texel, size_t k, Sum& sum) const;
  void addNode(const SurfaceSpot& spot, const TexelTree::Node& node, Sum& sum) const;
  bool sees(const SurfaceSpot& spot, uint32_t texel, const vec3& point) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  TexelRadiosityOptions options_;
  float side_ = 0.0f;
  std::vector<ObjectAtlas> atlases_;  // by object
  TexelSet texels_;
  TexelTree tree_;
  SurfaceDepths depths_;            // for stored visibility
  std::vector<Quarters> quarters_;  // by texel
  // By texel: radiosity of its open quarters before the last bounce [W/m²].
  std::vector<vec3> reflected_;
};

}  // namespace lamplighter
