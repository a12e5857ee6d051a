// The sum of many lights over the G-buffer, and the picture made of it.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "renderer/backends/gl/gl_gbuffer.h"
#include "renderer/backends/gl/gl_low_resolution.h"
#include "renderer/backends/gl/gl_patches.h"
#include "renderer/backends/gl/gl_shadow_maps.h"
#include "renderer/backends/gl/light_lists.h"
#include "renderer/backends/gl/sum_target.h"
#include "renderer/gl/radiance_texture.h"

namespace lamplighter::gl {

class GlLighting {
 public:
  GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls);
  void reload(const std::filesystem::path& shaders, const VplBuffer& vpls);

  // Irradiance of the G-buffer's pixels, starting from zero, or from the light maps.
  void sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
           const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
           const shared::ShadingParams& params, const PatchLights* patches);
  // Of the last sum, where passes were merged.
  int mergedPasses() const { return mergedPasses_; }
  int passesSaved() const { return passesSaved_; }
  // No light at all, for a G-buffer that nothing was summed over yet.
  void clear(int width, int height);
  // Of the last sum (Backend::readInterpolated()).
  std::vector<uint8_t> readInterpolated() const {
    return grids_[0].read(pixels_.width, pixels_.height);
  }
  std::shared_ptr<RadianceTexture> compose(const GlGBuffer& gbuffer, const Sky& sky, bool white);

  GLuint irradiance() const { return pixels_.irradiance.name(); }

  uint64_t bytes() const;

 private:
  // VPLs that one draw can sum: of one kind, with their maps in one array, in one block of VPLs.
  struct Batch {
    int kind = 0;
    int array = 0;
    size_t block = 0;
    size_t first = 0, count = 0;  // in the order of the sum
  };
  // What is known by patch: all but the VPLs themselves.
  struct Patches {
    GlPatches trees;
    LightLists lists;
    Buffer ranges, entries, hardPlaces;
  };
  // A sum, with the VPLs in its order and slots within their arrays.
  struct Sum {
    const GlShadowMaps& maps;
    const VplBuffer& buffer;
    std::vector<shared::Vpl> vpls;
    std::vector<Batch> batches;
    vec4 clampAndBias;  // of ShadingParams
    bool merges = false;
  };

  static Sum makeSum(const GlShadowMaps& maps, const VplBuffer& buffer,
                     std::span<const shared::Vpl> vpls, const shared::ShadingParams& params,
                     const PatchLights* patches);
  void takePatches(const GlScene& scene, const GlGBuffer& gbuffer, const Sum& sum,
                   const PatchLights& lights);
  void zero();
  // By lists of patches: with blocks.x, samples first and only then what lies between them and
  // cannot be interpolated; with blocks.y, the samples likewise.
  void sumListed(const GlScene& scene, const Sum& sum, const ShadingPoints& points,
                 SumTarget& target, size_t level, glm::ivec2 blocks);
  // What the light maps and light by transfer say at the points that are bound; `unmarked`: only
  // where the stencil buffer has no mark.
  void begin(const GlScene& scene, const SumTarget& target, bool unmarked);
  // Adds all VPLs there.
  void add(const GlScene& scene, const Sum& sum, const SumTarget& target, bool unmarked);
  // Of the program that composes with that kind, which it returns.
  const Program& setSky(const GlGBuffer& gbuffer, const Sky& sky);
  std::shared_ptr<RadianceTexture> freePicture(int width, int height);

  const Program& naive(int kind, bool hasLinks);

  Program naive_[3], listed_[3], merged_[3];  // by Vpl.position.w
  // The same where lights leave something out; compiled when it is first so.
  Program linked_[3];
  ProgramFiles linkedFiles_[3];
  std::filesystem::path shaders_;
  Program findPatches_;
  Program compose_[3];  // by kind of sky (shaders/shared/sky.h)
  VertexArray emptyVertexArray_;
  Framebuffer pictureFramebuffer_;
  SumTarget pixels_;
  bool isEmpty_ = true;  // pixels_ hold nothing yet: there is no light
  GlLowResolution low_;
  SampleGrid grids_[2];  // samples of pixels_, and, in haste, samples of these
  int mergedPasses_ = 0, passesSaved_ = 0;
  std::shared_ptr<const SkyImage> skyImage_;  // whose pixels skyTexture_ has
  Texture skyTexture_;
  std::unique_ptr<Patches> patches_;  // while the sums ask for them
  // Those that nobody else holds are drawn over.
  std::vector<std::shared_ptr<RadianceTexture>> pictures_;
};

}  // namespace lamplighter::gl
