// Computes with rays the light that the clamp of 1/d² removes: the missing light comes from
// surfaces nearer than the clamp distance (Kollig and Keller, "Illumination in the Presence of Weak
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
#include "renderer/scene/surface.h"

namespace lamplighter {

// For one set of VPLs, of which each pixel uses different ones. The result is an unbiased estimate:
// its mean over many sets is exact.
class BiasCompensation {
 public:
  // Emission of an object: its control (light_controls.h) and the reference brightness of the
  // control.
  struct Emission {
    uint32_t group = 0;
    float reference = 0.0f;  // 0: it emits nothing
  };
  struct Options {
    int bounces = 0;
    bool emission = true;  // the VPLs include direct ones on light sources
    float clampDistance = 0.0f;
    uint32_t paths = 2;             // per pixel: rays that look for a near surface
    uint32_t seed = 0, sample = 0;  // select the random numbers
    bool white = false;             // visible surfaces are shown white
    // Visible surfaces have speculars: this light is added to their diffuse part only.
    bool speculars = false;
    float leastRoughness = 0.1f;
    // By object: the light between its parts is known from transfer, so that it is not missing at
    // its pixels. Empty: for no object. Must outlive this object.
    std::span<const uint8_t> reflectsWithin = {};
    // By object: the direct light that pixels receive from it is exact (near_lamps.h). Empty: for
    // no object. Must outlive this object.
    std::span<const uint8_t> exactLamps = {};
    // For the light of each group of lights: the group of each VPL, and the emission of each
    // object. Must outlive this object. Empty: one group.
    std::span<const uint32_t> groups = {};
    std::span<const Emission> emissions = {};
  };
  BiasCompensation(const RenderScene& scene, const RayCaster& rays, std::span<const SceneVpl> vpls,
                   const Options& options);

  // The result for one pixel and its surface point.
  struct Pixel {
    vec3 light{0.0f};   // missing radiance for a white surface
    vec3 albedo{0.0f};  // 0 if the pixel hits nothing
    vec3 position{0.0f}, normal{0.0f};
  };
  // Contribution of one group to the light of a pixel.
  struct Contribution {
    uint32_t pixel = 0, group = 0;
    vec3 light{0.0f};
  };
  // Computes these rows of the view's picture, with pixels shifted by `jitter`, and writes them at
  // their indices of `pixels`. `byRow`: if not empty, receives the contributions of groups for each
  // row of the picture, which are then not included in the light of the pixels.
  void findRows(const View& view, vec2 jitter, int first, int last, std::span<Pixel> pixels,
                std::span<std::vector<Contribution>> byRow = {}) const;

 private:
  // A sun is sampled with one ray. Its sun shadow tiles are not chosen as VPLs: only one of many
  // tiles covers a point.
  struct Sun {
    VplId set;
    vec3 towards{0.0f}, irradiance{0.0f};
    uint32_t link = 0, group = 0;
  };
  // The VPLs that may light a surface after which the light bounces a given number of times.
  struct Choice {
    // All data needed to try a VPL, in one place.
    struct Entry {
      shared::Vpl vpl;
      float brightness;  // of its brightest channel, divided by the selection probability
      float weight;      // 1 / selection probability
      uint32_t group;
    };
    std::vector<Entry> entries;
    std::vector<float> upTo;  // cumulative probability, including this VPL
    // Speeds up find(): for each of as many equal parts of the cumulative sum, the first VPL in it.
    std::vector<uint32_t> guide;
    void makeGuide();
    size_t find(float below) const;  // the first VPL with upTo > below, or the last one
  };
  struct Place {
    vec3 position, normal;  // offset from the surface, on the lit side
    uint32_t leftOutBy;     // light_linking.h
  };
  // Receives the contributions of the groups to a pixel.
  struct Sink;
  Pixel pixel(const vec3& direction, const Hit& hit, uint32_t index,
              std::vector<Contribution>* contributions) const;
  // `whole`: the object whose light on itself is already known; none: 0xffffffff.
  void gather(Place from, uint32_t whole, const vec3& shadingNormal, PathSampler& sampler,
              Sink& sink) const;
  // Emission of the surface at a hit towards the ray.
  void addEmission(const Hit& hit, const Surface& s, bool front, const vec3& throughput,
                   Sink& sink) const;
  // The irradiance of suns and of other VPLs, times the throughput.
  void addSuns(const Place& at, const vec3& throughput, Sink& sink) const;
  void addVpls(const Place& at, const Choice& choice, vec2 u, const vec3& throughput,
               Sink& sink) const;
  bool sees(const Place& at, const shared::Vpl& vpl) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  Options options_;
  std::vector<Sun> suns_;
  std::vector<Choice> choices_;  // by the largest number of bounces that a VPL may have
};

}  // namespace lamplighter
