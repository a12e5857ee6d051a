// The texels of a changing scene: rebuilt when moved surfaces are at rest; unchanged texels are
// mapped to their old numbers (TexelMoves).
#pragma once

#include <functional>
#include <set>
#include <vector>

#include "renderer/services/services.h"
#include "renderer/texels/texel_moves.h"
#include "renderer/texels/texel_neighbours.h"

namespace lamplighter {

class SceneTexels {
 public:
  // Changes that matter for data stored by texel.
  enum class Change : uint8_t {
    none,
    moving,  // surfaces move; the texels of a moved object move with it
    lamps,   // only area lights moved, which block the light of other lights
    found    // the texels are rebuilt or at other positions
  };
  struct Update {
    Change change = Change::none;
    bool isAnew = false;  // all data stored by texel is invalid
    TexelMoves moves;     // for Change::lamps and Change::found
    PlacedTexels before;  // for Change::lamps and Change::found
    std::set<uint32_t>
        moved;  // objects that moved, were added or removed since the last such change
  };
  // Call in each frame with the changes since the last call. `sideOf`: returns the side of rebuilt
  // texels [m].
  Update take(const RenderScene& scene, Services& services, const RenderSceneChanges& changes,
              const std::function<float()>& sideOf, TexelOrder order);
  // The next take() rebuilds all texels.
  void restart() { isStarted_ = false; }
  // Whether the texels are up to date.
  bool isCurrent() const { return !isStale_ && moved_.empty(); }
  bool isStale() const { return isStale_; }

  const TexelSet& set() const { return texels_; }
  const PlacedTexels& places() const { return places_; }
  // By object.
  const std::vector<ObjectAtlas>& atlases() const { return atlases_; }
  float side() const { return side_; }  // [m]
  // Changes when the texels are rebuilt.
  uint32_t version() const { return version_; }
  uint64_t rays() const { return rays_; }  // of the last take()
  // The texels around a point of a triangle (world space) that are visible from it, with weights.
  // All weights are 0 if there are none.
  TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                     uint32_t triangle, bool isBack, const vec3& position) const;

  // The properties of the material of an object that affect texels and rays.
  struct Sides {
    bool isClear = false, isDoubleSided = false, isMasked = false;
    float cutoff = 0.0f, opacity = 1.0f;  // of a mask
    TextureRef texture;
    bool operator==(const Sides&) const = default;
  };

 private:
  bool takeSides(const RenderScene& scene);
  void takeAtlases(Services& services);

  std::vector<ObjectAtlas> atlases_;
  TexelSet texels_;
  TexelNeighbours neighbours_;
  PlacedTexels places_;       // when texels were last rebuilt
  std::vector<Sides> sides_;  // by object
  std::set<uint32_t> moved_;  // moved since then
  float side_ = 0.0f;
  bool isStarted_ = false;
  bool isStale_ = false;  // surfaces moved since texels were rebuilt
  uint32_t version_ = 0;
  uint64_t rays_ = 0;
};

// The mean albedo of each texel over its area.
std::vector<vec3> albedoOf(const RenderScene& scene, const TexelSet& texels);

// The side of texels of a scene [m]: `side`, or larger if there would be more than `most` texels.
// It grows in steps of a tenth, so that rounding errors of the area after moves do not change it.
float texelSideFor(const RenderScene& scene, float side, size_t most);

}  // namespace lamplighter
