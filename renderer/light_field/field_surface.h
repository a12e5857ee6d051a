// The surface of a scene for the light field: triangles that block light, with their positions in
// the atlas of texels.
#pragma once

#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class FieldSurface {
 public:
  static constexpr uint32_t kNone = TexelSet::kNone;

  // Numbers from this value are places on area lights, not texels.
  static constexpr uint32_t kLamps = 0x80000000u;
  // Places on the surface of an area light, in rows like the pixels of its picture.
  static constexpr int kLampSide = 8, kLampPlaces = kLampSide * kLampSide;

  FieldSurface() = default;
  // Clear materials let light through. `withLamps`: area lights send light and block it; otherwise
  // they block no light, so that they can move freely. `atlases`: by object, of the texels.
  FieldSurface(const RenderScene& scene, std::span<const ObjectAtlas> atlases,
               const TexelSet& texels, bool withLamps);

  struct Triangle {
    std::array<vec2, 3> texels;  // positions of its corners in the rectangle of the object [texels]
    uint32_t object = 0, triangle = 0;
    bool isMasked = false;  // by the alpha of its material
    bool hasTexels = false;
  };
  std::span<const Triangle> triangles() const { return triangles_; }
  // Corners of the triangles, as indices into RenderScene::positions. In an array of their own,
  // because most triangles are so small that no line meets them.
  using Corners = std::array<uint32_t, 3>;
  std::span<const Corners> corners() const { return corners_; }

  // The texel that reflects light at a point of a side of an object, given in texels of its
  // rectangle: the nearest one that is not buried; or a place on an area light, as a number of at
  // least kLamps. kNone: the side sends no light.
  uint32_t texelAt(uint32_t object, bool isBack, const vec2& texels) const;
  // The same for the hit of a ray.
  uint32_t texelAt(const RenderScene& scene, std::span<const ObjectAtlas> atlases, const Ray& ray,
                   const Hit& hit) const;
  // Area lights that send light, as indices of objects; place k of light i has the number kLamps +
  // i kLampPlaces + k.
  std::span<const uint32_t> lamps() const { return lamps_; }
  size_t bytes() const;

 private:
  void addLamp(const RenderScene& scene, uint32_t object);

  struct Side {
    glm::ivec2 size{0};
    std::vector<uint32_t> nearest;  // by row and column
  };
  std::vector<Triangle> triangles_;
  std::vector<Corners> corners_;
  std::vector<Side> sides_;  // the front and the back of each object
  std::vector<uint32_t> lamps_;
};

}  // namespace lamplighter
