// Sums many lights over the G-buffer.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/backends/gl/many_lights/gl_low_resolution.h"
#include "renderer/backends/gl/many_lights/gl_patches.h"
#include "renderer/backends/gl/many_lights/gl_shadow_maps.h"
#include "renderer/backends/gl/many_lights/light_lists.h"
#include "renderer/backends/gl/many_lights/sum_target.h"

namespace lamplighter::gl {

class GlLighting {
 public:
  GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Computes the irradiance of the G-buffer's pixels, starting from zero or from the light maps.
  void sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
           const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
           const shared::ShadingParams& params, const PatchLights* patches);
  // Passes of the last sum, if passes were merged.
  int mergedPasses() const { return mergedPasses_; }
  int passesSaved() const { return passesSaved_; }
  // Sets the irradiance to zero, for a G-buffer without a sum.
  void clear(int width, int height);
  // For the last sum (ManyLightsKernels::readInterpolated()).
  std::vector<uint8_t> readInterpolated(Waits& waits) const {
    return grids_[0].read(waits, pixels_.width, pixels_.height);
  }
  // The texture with the irradiance of the last sum, or zeros after clear().
  GLuint irradiance();

  uint64_t bytes() const;
  uint64_t uploaded() const;  // bytes of patches and light lists since construction

 private:
  // VPLs that one draw can sum: of one kind, with their maps in one array and their data in one VPL
  // block.
  struct Batch {
    int kind = 0;
    int array = 0;
    size_t block = 0;
    size_t first = 0, count = 0;  // in the order of the sum
  };
  // All data by patch, without the VPLs.
  struct Patches {
    GlPatches trees;
    LightLists lists, uploaded;  // of this sum, and what the buffers hold
    uint64_t bytesUploaded = 0;  // of lists
    StorageBuffer<glm::uvec2> ranges;
    StorageBuffer<uint32_t> entries, hardPlaces;
  };
  // One sum: the VPLs in its order, and their slots in the map arrays.
  struct Sum {
    const GlShadowMaps& maps;
    const VplBuffer& buffer;
    std::vector<shared::Vpl> vpls;
    std::vector<Batch> batches;
    vec4 clampAndBias;  // as in ShadingParams
    bool merges = false;
  };

  static Sum makeSum(const GlShadowMaps& maps, const VplBuffer& buffer,
                     std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
                     const PatchLights* patches);
  template <typename T>
  void upload(StorageBuffer<T>& buffer, std::span<const T> now, std::span<const T> before);
  void takePatches(const GlScene& scene, const GlGBuffer& gbuffer, const Sum& sum,
                   const PatchLights& lights);
  void zero();
  // Sums by lists per patch. With blocks.x, sums the samples first, and then the pixels between
  // them that cannot be interpolated; with blocks.y, the samples are treated in the same way.
  void sumListed(const GlScene& scene, const Sum& sum, const ShadingPoints& points,
                 SumTarget& target, size_t level, glm::ivec2 blocks);
  // Writes the light of light maps and of radiance transfer at the bound points; `unmarked`: only
  // where the stencil buffer is not marked.
  void begin(const GlScene& scene, const SumTarget& target, bool unmarked);
  // Adds all VPLs at the same points.
  void add(const GlScene& scene, const Sum& sum, const SumTarget& target, bool unmarked);
  const Program& naive(int kind, bool hasLinks);

  Program naive_[3], listed_[3], merged_[3];  // by Vpl.position.w
  // The same with light linking; compiled on first use.
  Program linked_[3];
  ProgramFiles linkedFiles_[3];
  std::filesystem::path shaders_;
  Program findPatches_;
  VertexArray emptyVertexArray_;
  SumTarget pixels_;
  bool isEmpty_ = true;  // pixels_ was never summed: its light is zero
  GlLowResolution low_;
  SampleGrid grids_[2];  // samples of pixels_ and, for quick pictures, samples of these samples
  int mergedPasses_ = 0, passesSaved_ = 0;
  uint64_t uploadedBefore_ = 0;       // by earlier patches_
  std::unique_ptr<Patches> patches_;  // while sums need them
};

}  // namespace lamplighter::gl
