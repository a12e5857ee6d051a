// The light elements of all objects of a scene, at their current positions.
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
  float edge = 0.25f;  // longest edge of an element, if memory allows it [m]
  size_t mostSamples =
      131072;  // edges grow by factors of √2 until there are at most this many samples
  bool operator==(const SurfaceMeshOptions&) const = default;
};

// A point of the surface in world space, and the side that receives light.
struct SurfaceSpot {
  vec3 position{0.0f};
  vec3 normal{0.0f};           // smooth; no normal map
  vec3 geometricNormal{0.0f};  // normal of the triangle
  uint32_t turn = 0;           // random bits by position that rotate gatherFrame()

  vec3 rayOrigin() const { return position + rayEpsilon(position) * geometricNormal; }
};

// Changes by an update of the mesh. Elements of all other objects keep their numbers and their
// positions in object space.
struct SurfaceMeshChange {
  bool isNew = false;  // all elements are new
  // Objects that have new elements, or that rays hit differently; ascending.
  std::vector<uint32_t> objects;
  std::vector<Bounds> boxes;  // their bounds before and after, if they were not added or removed
};

class SurfaceMesh {
 public:
  // Updates the elements. Shapes of unchanged meshes are kept.
  SurfaceMeshChange update(const RenderScene& scene, const RenderSceneChanges& changes,
                           const SurfaceMeshOptions& options);

  // The elements of one object; their numbers are consecutive.
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
  float edge() const { return edge_; }  // longest edge in use [m]
  size_t usedSamples() const { return usedSamples_; }
  size_t usedLeaves() const { return usedLeaves_; }

  static constexpr uint32_t kUnused = 0xffffffffu;
  uint32_t objectOfSample(uint32_t sample) const { return objectOfSample_[sample]; }
  uint32_t objectOfLeaf(uint32_t leaf) const { return objectOfLeaf_[leaf]; }
  // The points of a sample or an element.
  std::span<const SurfacePlace> placesOfSample(uint32_t sample) const;
  std::span<const SurfacePlace> placesOfLeaf(uint32_t leaf) const;
  std::array<uint32_t, 3> samplesOfLeaf(uint32_t leaf) const;
  bool isCluster(uint32_t leaf) const;

  // The values for the light at a point of a triangle. False if no light is stored: on back faces
  // of single-sided objects.
  bool find(const RenderScene& scene, uint32_t object, uint32_t triangle, bool isBack,
            const vec2& weights, MeshPoint& out) const;

  size_t bytes() const;

 private:
  // The properties of an object that affect its elements and ray hits.
  struct Identity {
    bool hasShape = false, hasBacks = false;
    ShapeKey key;
    AlphaMode alpha = AlphaMode::opaque;
    float cutoff = 0.0f, opacity = 1.0f;  // with an alpha mask
    TextureRef texture;
    bool operator==(const Identity&) const = default;
    static Identity of(const RenderScene& scene, uint32_t object);
  };
  // Cached properties of an object. Edges of level n are √2ⁿ times as long as requested.
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

// The current position and normals of a point of an object (world space).
SurfaceSpot spotAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);
// The diffuse albedo ρ at a point of an object, with textures; 0 in the holes of an alpha mask.
vec3 albedoAt(const RenderScene& scene, uint32_t object, const SurfacePlace& place);

}  // namespace lamplighter
