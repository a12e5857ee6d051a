// Bounced light of a scene at its texels: hierarchical radiosity along stored links, with
// visibility from stored depths or from rays (paper 3, sections 3 and 4).
//
// After a change of geometry, first depths and then links are computed over several frames; until
// then texels keep their light. After objects moved, came or went, only rays that meet them are
// traced again. When all is computed, the light is bitwise equal to that of a new start.
#pragma once

#include <optional>
#include <vector>

#include "renderer/services/services.h"
#include "renderer/surface_depths/depth_cache.h"
#include "renderer/surface_depths/texel_links.h"
#include "renderer/surface_depths/texel_senders.h"
#include "renderer/texels/scene_texels.h"
#include "renderer/texels/texel_irradiance.h"
#include "renderer/texels/texel_light.h"

namespace lamplighter {

// How visibility between texels is determined.
enum class TexelVisibility : uint8_t { stored, rays };

struct TexelRadiosityOptions {
  float texel = 0.25f;  // side where memory allows it [m]
  TexelOrder order = TexelOrder::zigzag;
  DepthMapLayout map;
  TexelVisibility visibility = TexelVisibility::stored;
  float linkError = 0.005f;  // form factor above which nodes are replaced by their children
  size_t memory = size_t{256} << 20;  // approximate limit for depths and links [bytes]
  int bounces = 2;
  uint32_t seed = 1;
  bool operator==(const TexelRadiosityOptions&) const = default;
};
// The side of texels that the memory limit allows [m].
float texelSideOf(const RenderScene& scene, const TexelRadiosityOptions& options);

class TexelRadiosity final : public TexelIrradiance {
 public:
  // Call in each frame, also in frames without update().
  void outdate(const RenderSceneChanges& changes) { unseen_.merge(changes); }
  // Continues the computation by up to about `mostRays` rays.
  void update(const RenderScene& scene, Services& services, const TexelRadiosityOptions& options,
              uint64_t mostRays);
  bool isDone() const override;
  // Share of the required depths and links that is computed, from 0 to 1.
  float progress() const;
  uint32_t version() const override { return version_; }
  uint32_t texelVersion() const override { return ground_.version(); }

  // Irradiance by bounced light, by texel [W/m²].
  const std::vector<vec3>& irradiance() const override { return irradiance_; }
  const std::vector<vec3>& reflected() const override { return radiosity_; }
  const TexelSet& texels() const override { return ground_.set(); }
  // By object.
  const std::vector<ObjectAtlas>& atlases() const { return ground_.atlases(); }
  const SurfaceDepths& depths() const { return depths_; }
  const TexelLinks& links() const { return links_; }
  const TexelTree& tree() const { return tree_; }
  const TexelRadiosityOptions& options() const { return options_; }
  TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                     uint32_t triangle, bool isBack, const vec3& position) const override {
    return ground_.blendAt(scene, rays, object, triangle, isBack, position);
  }
  // The contributions to the bounced light of a point (world space), by sender. None while links
  // are incomplete or changes are pending.
  std::optional<std::vector<TexelSender>> sendersTo(const RenderScene& scene, const RayCaster& rays,
                                                    uint32_t object, uint32_t triangle, bool isBack,
                                                    const vec3& position) const;

  // Work of the last update.
  struct Counts {
    uint64_t rays = 0;
    uint64_t links = 0;  // segments tested for links
    float texel = 0.0f;  // side [m]
    size_t bytes = 0;
  };
  const Counts& counts() const { return counts_; }
  void forget() { *this = TexelRadiosity(); }

 private:
  void takeGeometry(const RenderScene& scene, Services& services,
                    const RenderSceneChanges& changes);
  bool usesDepths() const { return options_.visibility == TexelVisibility::stored; }
  void findDepths(const RenderScene& scene, Services& services, uint64_t mostRays);
  void findSky(const RenderScene& scene, const RayCaster& rays, uint64_t most);
  void findLinks(const RenderScene& scene, const RayCaster& rays, uint64_t most);
  void bounce();

  TexelRadiosityOptions options_;
  RenderSceneChanges unseen_;
  LightSet lights_;
  SceneTexels ground_;
  TexelTree tree_;
  SurfaceDepths depths_;
  bool hasLookedOnDisk_ = false;        // whether the cache was searched for these depths
  std::optional<ContentKey> depthKey_;  // key of depths that will be saved
  TexelLinks links_;
  TexelLight light_;
  // Places when links were complete, and the objects that moved since then.
  PlacedTexels placesOfLinks_;
  std::set<uint32_t> movedSinceLinks_;
  std::vector<vec3> albedo_;      // by texel
  std::vector<vec3> irradiance_;  // by texel
  std::vector<vec3> radiosity_;   // by texel, before the last bounce: gathering it along the links
                                  // gives irradiance_
  bool isLit_ = false;            // irradiance_ is up to date
  uint32_t version_ = 0;
  Counts counts_;
};

}  // namespace lamplighter
