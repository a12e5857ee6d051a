// Glossy reflections of bounced light and the sky in a view, along rays of the lobes. The hits are
// stored, so that edits of light trace no rays. Neighbouring pixels share their rays.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/image/rows.h"
#include "renderer/surface_light/pixels/mirrored_light.h"
#include "renderer/surface_light/pixels/pixel_reflectance.h"

namespace lamplighter {

class PixelLobes {
 public:
  // Share of a lobe that is computed by rays, by roughness. The rest uses uniform light.
  static float tracedShare(float roughness);

  // `samples`: how many G-buffers of the view follow.
  void restart(const View& view, int samples, uint32_t seed);
  // Adds rows of the current G-buffer, in order: one ray for each pixel with a lobe. Returns the
  // number of rays.
  uint64_t add(const RenderScene& scene, const RayCaster& rays, const MirroredLight& light,
               const GBufferView& gbuffer, const SurfacePictureOptions& options, Rows rows);
  // Call when the mirrored light has changed.
  void outdateLight() { reflected_ = {}; }
  // Adds the radiance of the lobes: the mean over the complete samples.
  void addTo(const RenderScene& scene, const MirroredLight& light, Image& picture);
  size_t bytes() const {
    return rays_.size() * sizeof(LobeRay) + guides_.size() * sizeof(Guide) +
           reflected_.size() * sizeof(vec3);
  }

 private:
  struct LobeRay {
    uint64_t place = 0;  // MirroredLight::placeOf(), or the packed direction to the sky
    bool isToSky = false;
    std::array<uint16_t, 3> reflectance{};  // [1/65535]; 0: no ray
    bool isUsed() const { return (reflectance[0] | reflectance[1] | reflectance[2]) != 0; }
  };
  // Filter guide from the first ray: which pixels show parts of the same reflection.
  struct Guide {
    vec3 normal{0.0f};
    uint32_t object = 0;
    float radius = 0.0f;  // radius of the blur by the lobe [pixels]
  };
  void reflect(const RenderScene& scene, const MirroredLight& light);
  std::vector<float> evenRadii() const;
  void average(const std::vector<vec3>& from, const std::vector<float>& radii, int step,
               std::vector<vec3>& to) const;

  View view_;
  uint32_t seed_ = 0;
  int samples_ = 0, added_ = 0;
  std::vector<LobeRay> rays_;  // by sample, then by pixel; empty without glossy pixels
  std::vector<Guide> guides_;  // by pixel
  // By pixel: radiance of the lobes [W/(m² sr)]; empty if it is outdated.
  std::vector<vec3> reflected_;
};

}  // namespace lamplighter
