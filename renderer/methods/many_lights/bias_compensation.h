// The light that the clamp of 1/d² takes away, found by rays: what is missing comes from surfaces
// nearer than the clamp distance (Kollig and Keller, "Illumination in the Presence of Weak
// Singularities", 2004).
#pragma once

#include <span>
#include <vector>

#include "renderer/base/low_discrepancy.h"
#include "renderer/image/image.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Under one set of VPLs, of which each pixel takes other ones: an estimate whose mean over many
// sets is exact.
class BiasCompensation {
 public:
  struct Options {
    int bounces = 0;
    bool emission = true;  // the VPLs stand for lights themselves too
    float clampDistance = 0.0f;
    uint32_t paths = 2;             // directions in which a pixel looks for a surface nearby
    uint32_t seed = 0, sample = 0;  // which random numbers
    bool white = false;             // what is seen is shown as if it were white
    // What is seen has speculars: the diffuse part of it gets this light, the lobe does without.
    bool speculars = false;
    float leastRoughness = 0.1f;
    // By object, whether what its parts give to each other is known otherwise: no pixel on it lacks
    // that. Empty: of none. Must outlive this.
    std::span<const uint8_t> reflectsWithin = {};
  };
  BiasCompensation(const RenderScene& scene, const RayCaster& rays, std::span<const SceneVpl> vpls,
                   const Options& options);

  // What is found for one pixel, and where.
  struct Pixel {
    vec3 light{0.0f};   // what it lacks of radiance, were it white
    vec3 albedo{0.0f};  // 0 where nothing is seen
    vec3 position{0.0f}, normal{0.0f};
  };
  // These rows of the view's picture, pixels moved by `jitter`, into their places in `pixels`.
  void findRows(const View& view, vec2 jitter, int first, int last, std::span<Pixel> pixels) const;

 private:
  // A ray goes to each sun: its squares would be tried in vain where one of many covers a place.
  struct Sun {
    VplId set;
    vec3 towards{0.0f}, irradiance{0.0f};
    uint32_t link = 0;
  };
  // Other VPLs that may still light a surface from which light bounces a given number of times on.
  struct Choice {
    // All that is asked of one that is tried, side by side.
    struct Entry {
      shared::Vpl vpl;
      float brightness;  // of its brightest channel, over the probability of trying it
      float weight;      // 1 over that
    };
    std::vector<Entry> entries;
    std::vector<float> upTo;  // sum of probabilities, this one's included
    // For that many equal parts of the sum: the first that reaches into it.
    std::vector<uint32_t> guide;
    void makeGuide();
    size_t find(float below) const;  // the first with upTo > below, or the last
  };
  struct Place {
    vec3 position, normal;  // off its surface, on the lit side
    uint32_t leftOutBy;     // light_linking.h
  };
  Pixel pixel(const vec3& direction, const Hit& hit, uint32_t index) const;
  // `whole`: the object whose light upon itself is known; none: 0xffffffff.
  vec3 gather(Place from, uint32_t whole, const vec3& shadingNormal, PathSampler& sampler) const;
  vec3 irradianceOfSuns(const Place& at) const;
  vec3 irradiance(const Place& at, const Choice& choice, vec2 u) const;
  bool sees(const Place& at, const shared::Vpl& vpl) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  Options options_;
  std::vector<Sun> suns_;
  std::vector<Choice> choices_;  // by the number of bounces that a VPL may have behind it
};

}  // namespace lamplighter
