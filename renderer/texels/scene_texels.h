// The texels of a scene as it changes: found anew when surfaces that moved are at rest, with the
// numbers that they had before.
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
  // What changed for those who keep something by texel.
  enum class Change : uint8_t {
    none,
    moving,  // surfaces move; the texels of a moved object go with it
    lamps,   // only area lights moved, which block the light of others
    found    // the texels are other ones, or at other places
  };
  struct Update {
    Change change = Change::none;
    bool isAnew = false;       // nothing that was kept by texel may remain
    TexelMoves moves;          // of lamps and found
    PlacedTexels before;       // likewise
    std::set<uint32_t> moved;  // objects that moved, came or went since the last one of these
  };
  // Takes the changes of each frame since the last call. `sideOf`: of texels that are found anew
  // [m].
  Update take(const RenderScene& scene, Services& services, const RenderSceneChanges& changes,
              const std::function<float()>& sideOf, TexelOrder order);
  // The next take() rebuilds all texels.
  void restart() { isStarted_ = false; }
  // Whether the texels are those of now.
  bool isCurrent() const { return !isStale_ && moved_.empty(); }
  bool isStale() const { return isStale_; }

  const TexelSet& set() const { return texels_; }
  const PlacedTexels& places() const { return places_; }
  // By object.
  const std::vector<ObjectAtlas>& atlases() const { return atlases_; }
  float side() const { return side_; }  // [m]
  // Differs if the texels are other ones.
  uint32_t version() const { return version_; }
  uint64_t rays() const { return rays_; }  // of the last take()
  // The texels around a point of a triangle (world space) that it sees. No weights: it has none.
  TexelBlend blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                     uint32_t triangle, bool isBack, const vec3& position) const;

  // What texels and rays depend on, of the material of an object.
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
  PlacedTexels places_;       // when texels were found last
  std::vector<Sides> sides_;  // by object
  std::set<uint32_t> moved_;  // since then
  float side_ = 0.0f;
  bool isStarted_ = false;
  bool isStale_ = false;  // surfaces moved since texels were found
  uint32_t version_ = 0;
  uint64_t rays_ = 0;
};

// The mean albedo of each texel, over its area.
std::vector<vec3> albedoOf(const RenderScene& scene, const TexelSet& texels);

// The side of texels of a scene: `side` [m], or larger where there would be more than so many. They
// get larger by a tenth at a time, so that moves, which change the area by rounding, do not change
// them.
float texelSideFor(const RenderScene& scene, float side, size_t most);

}  // namespace lamplighter
