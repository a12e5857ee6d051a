// The surface of a scene as the light field sees it: triangles that block light, each with its
// place among the texels that keep light.
#pragma once

#include <span>
#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class FieldSurface {
 public:
  static constexpr uint32_t kNone = TexelSet::kNone;

  // Numbers from here on are of places on area lights, not of texels.
  static constexpr uint32_t kLamps = 0x80000000u;
  // Of the surface of an area light, in rows of the picture that it may have.
  static constexpr int kLampSide = 8, kLampPlaces = kLampSide * kLampSide;

  FieldSurface() = default;
  // Clear materials let light through. `withLamps`: area lights send light and block it; otherwise
  // they block no light, so that they can move freely. `atlases`: by object, of the texels.
  FieldSurface(const RenderScene& scene, std::span<const ObjectAtlas> atlases,
               const TexelSet& texels, bool withLamps);

  struct Triangle {
    std::array<vec2, 3> texels;  // where its corners are in the rectangle of the object
    uint32_t object = 0, triangle = 0;
    bool isMasked = false;  // by the alpha of its material
    bool hasTexels = false;
  };
  std::span<const Triangle> triangles() const { return triangles_; }
  // Of each of them, by number in RenderScene::positions. Apart from the rest, because most of them
  // are so small that no line meets them.
  using Corners = std::array<uint32_t, 3>;
  std::span<const Corners> corners() const { return corners_; }

  // The texel that reflects light from a place of a side of an object, given in texels of its
  // rectangle: the nearest one that is not buried; or the place of an area light, kLamps and more.
  // kNone: the side sends nothing.
  uint32_t texelAt(uint32_t object, bool isBack, const vec2& texels) const;
  // Of a hit of a ray.
  uint32_t texelAt(const RenderScene& scene, std::span<const ObjectAtlas> atlases, const Ray& ray,
                   const Hit& hit) const;
  // Area lights that send light, by object; place number k of the light i is kLamps + i kLampPlaces
  // + k.
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
