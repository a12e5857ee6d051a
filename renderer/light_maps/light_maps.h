// Light maps (paper 1, 4.3.2 and 4.5.2): for each patch the irradiance of all lights that reach
// some of it, without their shadows, on a grid. Pixels take the shadows away again
// (patch_lights.h).
//
// A tile is the grid of one leaf patch. It begins and ends at the patch's corners, so bilinear
// filtering never leaves it: no gutter is needed, nothing bleeds, and neighbours that hold the same
// lights agree along their border. Texels past the surface's edge are light on its plane.
//
// The sums are fixed-point numbers: each contribution is rounded to a multiple of 2⁻²⁶ W/m² and
// added as a double, which is exact up to 2²⁷ W/m². Adding a light and taking it away restores the
// very same bits in any order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/camera.h"
#include "renderer/visibility/visibility_database.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

struct LightMapTile {
  int patch = kNone;          // the leaf, of the object's patches
  uint32_t first = 0;         // its first texel in the object's arrays; row after row
  int columns = 0, rows = 0;  // along the chart's tangent and bitangent, 2 at least
};

class LightMaps {
 public:
  struct Options {
    float texel = 0.1f;          // spacing of texels, where a patch needs no more than 33 [m]
    float clampDistance = 0.0f;  // of ShadingParams [m]
    // Where they would hold more, texels are larger everywhere; where even two a side of each patch
    // are too many there are no maps.
    uint64_t mostBytes = UINT64_MAX;
    uint64_t mostTexels = UINT64_MAX;  // likewise: that the backend takes
    bool operator==(const Options&) const = default;
  };

  // Takes in what changed; once after each setScene() of the database. `bySlot`: the lights as the
  // database has them, with their intensities. Afterwards the maps are those that would be made
  // from nothing; with a view, those of tiles whose fronts that may show. Others are not brought up
  // to date until it may, and until then not to be read. Texels become larger at once where memory
  // asks for it, but smaller only where they may: all maps are made anew for that.
  void update(const RenderScene& scene, const VisibilityDatabase& visibility,
              std::span<const shared::Vpl> bySlot, const Options& options,
              const View* view = nullptr, bool mayBeFiner = true);

  // A leaf's tile; null where pixels have to sum all lights themselves: its chart is not shaded
  // flat, or it is in no chart.
  const LightMapTile* tile(uint32_t object, int leaf) const {
    const int index = objects_[object].tileOfPatch[static_cast<size_t>(leaf)];
    return index == kNone ? nullptr : &objects_[object].tiles[static_cast<size_t>(index)];
  }
  // Whether the leaf's tile holds the light in each slot. Only for leaves with a tile.
  class Held {
   public:
    explicit Held(const uint64_t* words) : words_(words) {}
    bool operator[](size_t slot) const { return (words_[slot / 64] >> slot % 64 & 1) != 0; }

   private:
    const uint64_t* words_;  // a bit a slot
  };
  Held held(uint32_t object, int leaf) const {
    const size_t index =
        static_cast<size_t>(objects_[object].tileOfPatch[static_cast<size_t>(leaf)]);
    return Held(objects_[object].held.data() + index * words_);
  }
  // A leaf's tile, to be read at many points; until the maps or patches change.
  class Sampler {
   public:
    Sampler(const LightMaps& maps, const ObjectPatches& patches, uint32_t object, int leaf);
    // E on the front of its plane at the point nearest to `position` [W/m²].
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

    // The same of eight points, by coordinate; e: rgb. What is not a point of the tile's chart may
    // be among them.
    static constexpr size_t kPoints = 8;
    void irradiance(const float* x, const float* y, const float* z,
                    std::span<vec4, kPoints> e) const;

   private:
    const Chart& chart_;
    vec2 min_, size_, last_;  // of the patch; the last column and row
    ptrdiff_t columns_;
    const vec4* texels_;
  };
  vec3 irradiance(const ObjectPatches& patches, uint32_t object, int leaf,
                  const vec3& position) const {
    return Sampler(*this, patches, object, leaf).irradiance(position);
  }
  // An object's texels; rgb: E [W/m²].
  std::span<const vec4> texels(uint32_t object) const { return objects_[object].irradiance; }
  const Revision& revision(uint32_t object) const { return objects_[object].revision; }

  size_t objects() const { return objects_.size(); }
  size_t texels() const;
  float texel() const { return texel_; }  // spacing as memory allows [m]; 0: there are no maps
  bool couldBeFiner() const { return texel_ != fitting_; }
  uint64_t texelsWritten() const { return written_; }  // texels × lights, since they were made
  uint64_t bytes() const;
  uint64_t hash() const;  // of all sums

 private:
  struct Size {
    size_t tiles = 0, texels = 0;
  };
  struct Object {
    std::vector<bool> isFlat;      // by chart: whether it has light maps
    Size wanted;                   // with texels as they are asked for
    std::vector<int> tileOfPatch;  // kNone: no tile
    std::vector<LightMapTile> tiles;
    std::vector<double> sums;      // three a texel: all r of a tile, then g, then b
    std::vector<vec4> irradiance;  // the same, as it is read
    // Tiles × words_, a bit a slot: lights in the sums, and those that are known not to be smooth
    // enough for them.
    std::vector<uint64_t> held, refused;
    std::vector<uint8_t> isLeftOut;  // by tile: it was not seen when something changed
    Revision revision;               // of tiles and texels
  };
  // With texels of some spacing, tile by tile: patch, columns, rows.
  template <typename F>
  static void forEachTile(const ObjectPatches& patches, const std::vector<bool>& isFlat,
                          float texel, F take);
  static Size sizeOf(const ObjectPatches& patches, const std::vector<bool>& isFlat, float texel);
  float fittingTexel(const VisibilityDatabase& visibility, size_t words) const;
  void makeTiles(Object& object, const ObjectPatches& patches) const;
  void resize(size_t slots);

  std::vector<Object> objects_;
  std::vector<shared::Vpl> lights_;  // by slot, as they were added
  size_t words_ = 0;                 // of a tile's bits
  Options options_;
  float texel_ = 0.0f, fitting_ = 0.0f;  // as they are, and as memory allows with so many words
  size_t fittingWords_ = 0;
  uint64_t written_ = 0;
};

}  // namespace lamplighter
