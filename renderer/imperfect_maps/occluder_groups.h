// All triangles that rays can hit, in groups of neighbours. The importance of occluders is computed
// by group, so that its cost grows with the number of groups and not of triangles.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "renderer/imperfect_maps/occluder_order.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Neighbouring triangles of an object. Lengths are in the unit of the scene, in world space.
struct OccluderGroup {
  vec3 centre{0.0f};    // by area
  float radius = 0.0f;  // radius of a bounding sphere of the triangles
  float area = 0.0f;    // of one side
  // M = Σ Aᵢ nᵢ nᵢᵀ of areas and normals: xx, yy, zz and yz, zx, xy. Its trace is `area`. ωᵀ M ω is
  // 0 for a plane that is seen edge-on and `area` for one that is seen face-on.
  vec3 facing{0.0f}, facingMixed{0.0f};
  uint32_t object = 0;            // index into RenderScene::objects
  uint32_t first = 0, count = 0;  // its part of OccluderGroups::triangles()
};

struct OccluderTriangle {
  uint32_t triangle = 0;  // within the object
  float areaUpTo = 0.0f;  // sum of the areas of the group up to and including this one
};

// The groups of all objects except clear (transmissive) ones. Holes of alpha masks are not cut out.
// The division of a mesh (occluder_order.h) is found once for all its instances.
class OccluderGroups {
 public:
  OccluderGroups() = default;
  explicit OccluderGroups(const RenderScene& scene);

  // Updates only objects that moved, were added or became opaque, in parallel. The result is
  // bitwise equal to that of the constructor. Returns whether anything changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes);

  // In the order of the objects.
  std::span<const OccluderGroup> groups() const { return groups_; }
  std::span<const OccluderTriangle> triangles() const { return triangles_; }
  std::span<const OccluderTriangle> trianglesOf(const OccluderGroup& group) const {
    return std::span(triangles_).subspan(group.first, group.count);
  }
  double areaOf(uint32_t object) const { return objects_[object].area; }  // 0: hidden or clear
  size_t objects() const { return objects_.size(); }
  size_t memoryBytes() const;

 private:
  using MeshPart = std::pair<std::shared_ptr<const Mesh>, uint32_t>;  // primitive
  struct Object {
    std::shared_ptr<const OccluderOrder> order;  // from the last time that it was visible
    uint32_t firstGroup = 0, groups = 0;
    uint32_t firstTriangle = 0, triangles = 0;
    double area = 0.0;
  };

  std::map<MeshPart, std::shared_ptr<const OccluderOrder>> orders_;
  std::vector<Object> objects_;
  std::vector<OccluderGroup> groups_;
  std::vector<OccluderTriangle> triangles_;

  void findOrders(const RenderScene& scene, std::span<const uint8_t> isStale, bool isRebuilt);
  bool place(const RenderScene& scene, std::vector<uint8_t>& isStale);
  void measure(const RenderScene& scene, uint32_t object);
};

}  // namespace lamplighter
