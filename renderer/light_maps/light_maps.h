// Light maps (paper 1, 4.3.2 and 4.5.2): for each patch, a grid with the unshadowed irradiance of
// all lights that reach at least a part of it. Pixels subtract the shadows (patch_lights.h).
//
// A tile is the grid of one leaf patch. Its outer texels lie on the border of the patch, so
// bilinear filtering never leaves it: no gutter is needed, nothing bleeds, and neighbours that hold
// the same lights agree along their common border. Texels outside the surface hold the light on its
// plane.
//
// The sums are fixed-point numbers: each contribution is rounded to a multiple of 2⁻²⁶ W/m² and
// added as a double, which is exact up to 2²⁷ W/m². Adding a light and subtracting it again
// restores the same bits, in any order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/light_maps/light_map_tiles.h"
#include "renderer/scene/camera.h"
#include "renderer/visibility/visibility_database.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class LightMaps {
 public:
  struct Options {
    // spacing of texels [m]; larger where a patch would need more than 33 per side
    float texel = 0.1f;
    float clampDistance = 0.0f;  // of ShadingParams [m]
    // If the maps would need more memory, the spacing grows everywhere. If even 2×2 texels per
    // patch need too much, there are no light maps.
    uint64_t mostBytes = UINT64_MAX;
    uint64_t mostTexels = UINT64_MAX;  // limit of the backend, with the same effect
    bool operator==(const Options&) const = default;
  };

  // Applies the changes; call once after each setScene() of the database. `bySlot`: the lights of
  // the database, with their intensities. Afterwards the maps are bitwise equal to maps computed
  // from scratch. With a view, this holds only for tiles whose front the view may show; other tiles
  // are updated when a view may show them and must not be read before. The spacing grows
  // immediately when memory requires it, but shrinks only when the caller allows it, because that
  // recomputes all maps.
  void update(const RenderScene& scene, const VisibilityDatabase& visibility,
              std::span<const shared::Vpl> bySlot, const Options& options,
              const View* view = nullptr, bool mayBeFiner = true);

  // The tile of a leaf. Null if pixels must sum all lights themselves: the leaf is in no chart, or
  // its chart is not flat-shaded.
  const LightMapTile* tile(uint32_t object, int leaf) const {
    const int index = objects_[object].tiles.ofPatch[static_cast<size_t>(leaf)];
    return index == kNone ? nullptr : &objects_[object].tiles.tiles[static_cast<size_t>(index)];
  }
  // Tells whether the tile of a leaf holds the light in a slot. Only for leaves that have a tile.
  class Held {
   public:
    explicit Held(const uint64_t* words) : words_(words) {}
    bool operator[](size_t slot) const { return (words_[slot / 64] >> slot % 64 & 1) != 0; }

   private:
    const uint64_t* words_;  // one bit per slot
  };
  Held held(uint32_t object, int leaf) const {
    const size_t index =
        static_cast<size_t>(objects_[object].tiles.ofPatch[static_cast<size_t>(leaf)]);
    return Held(objects_[object].held.data() + index * words_);
  }
  // Reads the tile of a leaf at many points. Valid until the maps or the patches change.
  class Sampler {
   public:
    Sampler(const LightMaps& maps, const ObjectPatches& patches, uint32_t object, int leaf);
    // E on the front of the tile's plane, at the point nearest to `position` [W/m²].
    vec3 irradiance(const vec3& position) const {
      const vec2 p = chart_.project(position);
      const vec2 at = glm::clamp((p - min_) / size_, 0.0f, 1.0f) * last_;
      const vec2 low = glm::min(glm::floor(at), last_ - 1.0f);
      const vec2 w = at - low;
      const vec4* texel =
          texels_ + static_cast<ptrdiff_t>(low.y) * columns_ + static_cast<ptrdiff_t>(low.x);
      const vec4 top = glm::mix(texel[0], texel[1], w.x);
      const vec4 bottom = glm::mix(texel[columns_], texel[columns_ + 1], w.x);
      return vec3(glm::mix(top, bottom, w.y));
    }

    // The same for eight points; arguments by coordinate, e: by channel. Points outside the tile's
    // chart are allowed.
    static constexpr size_t kPoints = 8;
    void irradiance(const float* x, const float* y, const float* z,
                    std::span<vec4, kPoints> e) const;

   private:
    const Chart& chart_;
    vec2 min_, size_, last_;  // of the patch; last_: the last column and row
    ptrdiff_t columns_;
    const vec4* texels_;
  };
  vec3 irradiance(const ObjectPatches& patches, uint32_t object, int leaf,
                  const vec3& position) const {
    return Sampler(*this, patches, object, leaf).irradiance(position);
  }
  // The texels of an object; rgb is E [W/m²].
  std::span<const vec4> texels(uint32_t object) const { return objects_[object].irradiance; }
  // Changes with the set of patches that have tiles.
  const Revision& coverage() const { return coverage_; }
  const Revision& revision(uint32_t object) const { return objects_[object].revision; }
  // Changes with the tiles of an object and their positions in texels().
  const Revision& tiling(uint32_t object) const { return objects_[object].tiling; }
  std::span<const LightMapTile> tiles(uint32_t object) const {
    return objects_[object].tiles.tiles;
  }
  // By tile: how often its texels were written under this tiling.
  std::span<const uint32_t> writes(uint32_t object) const { return objects_[object].writes; }

  size_t objects() const { return objects_.size(); }
  size_t texels() const;
  float texel() const { return texel_; }  // spacing that memory allows [m]; 0: no light maps
  bool couldBeFiner() const { return texel_ != fitting_; }
  uint64_t texelsWritten() const { return written_; }  // texels × lights since construction
  uint64_t bytes() const;
  uint64_t hash() const;  // of all sums

 private:
  struct Size {
    size_t tiles = 0, texels = 0;
  };
  struct Object {
    std::vector<uint8_t> levels;  // of the database, for which the tiles were found
    FlatCharts isFlat;
    Size wanted;  // at the requested texel spacing
    LightMapTiles tiles;
    std::vector<double> sums;      // three per texel: all r of a tile, then all g, then all b
    std::vector<vec4> irradiance;  // the same values as floats, for reading
    // Tiles × words_, one bit per slot: lights that are in the sums, and lights that are known to
    // vary too fast for them.
    std::vector<uint64_t> held, refused;
    // by tile: it was not visible when something changed, so it is outdated
    std::vector<uint8_t> isLeftOut;
    std::vector<uint32_t> writes;  // by tile
    Revision revision;             // of tiles and texels
    Revision tiling;               // of tiles
  };
  static Size sizeOf(const Object& object, const ObjectPatches& patches, float texel);
  float fittingTexel(const VisibilityDatabase& visibility, size_t words) const;
  void makeTiles(Object& object, const ObjectPatches& patches) const;
  void resize(size_t slots);

  std::vector<Object> objects_;
  std::vector<shared::Vpl> lights_;  // by slot, in the state that is in the sums
  Revision coverage_;
  size_t words_ = 0;  // per tile, for its bits
  Options options_;
  // the current spacing, and the one that memory allows with fittingWords_
  float texel_ = 0.0f, fitting_ = 0.0f;
  size_t fittingWords_ = 0;
  uint64_t written_ = 0;
};

}  // namespace lamplighter
