// The elements of light of all objects of a scene, at their present places.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/patches/topology.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/surface_shape.h"

namespace lamplighter {

struct SurfaceMeshOptions {
  float edge = 0.25f;           // longest edge of an element where memory allows it [m]
  size_t mostSamples = 131072;  // edges grow by √2 until there are no more samples than this
  bool operator==(const SurfaceMeshOptions&) const = default;
};

// A point of the surface in world space, and the side that receives light.
struct SurfaceSpot {
  vec3 position{0.0f};
  vec3 normal{0.0f};           // smooth; no normal map
  vec3 geometricNormal{0.0f};  // of the triangle

  vec3 rayOrigin() const { return position + rayEpsilon(position) * geometricNormal; }
};

class SurfaceMesh {
 public:
  // Returns whether the elements have other numbers than before; otherwise only those of moved
  // objects have other places. Shapes of unchanged meshes are kept.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes,
              const SurfaceMeshOptions& options);

  // Numbers of the elements of one object: consecutive, in the order of the objects.
  struct Part {
    std::shared_ptr<const SurfaceShape> shape;  // null: rays do not hit it
    uint32_t firstSample = 0, firstLeaf = 0, firstBlend = 0;
  };
  const Part& part(uint32_t object) const { return parts_[object]; }
  size_t objects() const { return parts_.size(); }
  size_t samples() const { return samples_; }
  size_t leaves() const { return leaves_; }
  // Values are the samples, then the blends.
  size_t values() const { return samples_ + blends_; }
  float edge() const { return edge_; }  // in use [m]

  uint32_t objectOfSample(uint32_t sample) const { return objectOfSample_[sample]; }
  uint32_t objectOfLeaf(uint32_t leaf) const { return objectOfLeaf_[leaf]; }
  // The places of an element.
  std::span<const SurfacePlace> placesOfSample(uint32_t sample) const;
  std::span<const SurfacePlace> placesOfLeaf(uint32_t leaf) const;
  std::array<uint32_t, 3> samplesOfLeaf(uint32_t leaf) const;
  bool isCluster(uint32_t leaf) const;

  // The light at a point of a triangle. False where none is kept: on back faces of objects without
  // backs.
  bool find(const RenderScene& scene, uint32_t object, uint32_t triangle, bool isBack,
            const vec2& weights, MeshPoint& out) const;

  size_t bytes() const;

 private:
  bool findShapes(const RenderScene& scene, float edge);
  void number();

  SurfaceMeshOptions options_;
  float edge_ = 0.0f;
  std::vector<Part> parts_;
  std::vector<uint32_t> objectOfSample_, objectOfLeaf_;
  size_t samples_ = 0, leaves_ = 0, blends_ = 0;
  std::vector<ShapeKey> keys_;
  std::vector<bool> hasBacks_;
};

// Where a place of an object is now.
SurfaceSpot spotAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);
// ρ there, with textures; 0 in the holes of an alpha mask.
vec3 albedoAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);

}  // namespace lamplighter
