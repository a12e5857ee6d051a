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

  FieldSurface() = default;
  // Area lights block no bounced light, so that they can move freely, and clear materials let it
  // through. `atlases`: by object, of the texels.
  FieldSurface(const RenderScene& scene, std::span<const ObjectAtlas> atlases,
               const TexelSet& texels);

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
  // rectangle: the nearest one that is not buried. kNone: the side reflects nothing.
  uint32_t texelAt(uint32_t object, bool isBack, const vec2& texels) const;
  // Of a hit of a ray.
  uint32_t texelAt(const RenderScene& scene, std::span<const ObjectAtlas> atlases, const Ray& ray,
                   const Hit& hit) const;
  size_t bytes() const;

 private:
  struct Side {
    glm::ivec2 size{0};
    std::vector<uint32_t> nearest;  // by row and column
  };
  std::vector<Triangle> triangles_;
  std::vector<Corners> corners_;
  std::vector<Side> sides_;  // the front and the back of each object
};

}  // namespace lamplighter
