// The elements of light of all objects of a scene, at their present places.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "renderer/base/number_ranges.h"
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
  uint32_t turn = 0;           // random bits of the place; they turn gatherFrame()

  vec3 rayOrigin() const { return position + rayEpsilon(position) * geometricNormal; }
};

// What an update of the mesh left. Elements of all other objects keep their numbers and places in
// the space of the object.
struct SurfaceMeshChange {
  bool isNew = false;  // all elements are other ones
  // Objects that have other elements, or that rays hit otherwise than before; ascending.
  std::vector<uint32_t> objects;
  std::vector<Bounds> boxes;  // where they are and were, if they did not come or go
};

class SurfaceMesh {
 public:
  // Shapes of unchanged meshes are kept.
  SurfaceMeshChange update(const RenderScene& scene, const RenderSceneChanges& changes,
                           const SurfaceMeshOptions& options);

  // Numbers of the elements of one object: consecutive.
  struct Part {
    std::shared_ptr<const SurfaceShape> shape;  // null: rays do not hit it
    uint32_t firstSample = 0, firstLeaf = 0, firstBlend = 0, firstNeighbour = 0;
  };
  const Part& part(uint32_t object) const { return parts_[object]; }
  size_t objects() const { return parts_.size(); }
  // One more than the largest number. Some numbers are unused: objectOfSample() is kUnused.
  size_t samples() const { return samples_.end(); }
  size_t leaves() const { return leaves_.end(); }
  size_t neighbours() const { return neighbours_.end(); }
  // Values are the samples, then the blends.
  size_t values() const { return samples() + blends_.end(); }
  float edge() const { return edge_; }  // in use [m]
  size_t usedSamples() const { return usedSamples_; }
  size_t usedLeaves() const { return usedLeaves_; }

  static constexpr uint32_t kUnused = 0xffffffffu;
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
  // What decides about the elements of an object, and what rays see of it.
  struct Identity {
    bool hasShape = false, hasBacks = false;
    ShapeKey key;
    AlphaMode alpha = AlphaMode::opaque;
    float cutoff = 0.0f, opacity = 1.0f;  // with an alpha mask
    TextureRef texture;
    bool operator==(const Identity&) const = default;
    static Identity of(const RenderScene& scene, uint32_t object);
  };
  // What is found of an object once. Edges of level n are √2ⁿ times as long as those asked for.
  struct Known {
    float area = 0.0f, longest = 0.0f;          // [m²] and [m]
    std::map<int, size_t> samples;              // by level: with edges of levelEdge()
    std::shared_ptr<const SurfaceShape> shape;  // of the level `shapeLevel`
    int shapeLevel = -1;
  };
  float levelEdge(int level) const;
  double leastSamples(uint32_t object, int level) const;
  void findShape(const RenderScene& scene, uint32_t object, int level);
  bool findShapes(const RenderScene& scene, int level);
  void renumber(uint32_t object);

  SurfaceMeshOptions options_;
  float edge_ = 0.0f;
  std::vector<Part> parts_;
  std::vector<Identity> identities_;
  std::vector<Known> known_;  // by object
  std::vector<uint32_t> objectOfSample_, objectOfLeaf_;
  NumberRanges samples_, leaves_, blends_, neighbours_;
  size_t usedSamples_ = 0, usedLeaves_ = 0;
};

// Where a place of an object is now.
SurfaceSpot spotAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);
// ρ there, with textures; 0 in the holes of an alpha mask.
vec3 albedoAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);

}  // namespace lamplighter
