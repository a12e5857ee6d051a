// The only wrapper of Embree: traces world-space rays against a RenderScene. Alpha masks are
// tested; clear (transmissive) materials are excluded. Results are bit-equal at any number of
// threads and on every x86-64-v3 processor, because the instruction set is fixed and distances and
// barycentrics are computed from the triangle (triangle_hit.h). Of triangles that are equally near
// within rounding at an edge, intersect() and intersect8() take the one with the least distance,
// then with the least object and triangle. Exception: where surfaces coincide, Embree chooses one,
// and the choice may differ between processors.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct Ray {
  vec3 origin{0.0f};
  float tNear = 0.0f;  // distances in units of |direction|
  vec3 direction{0.0f, 0.0f, 1.0f};
  float tFar = std::numeric_limits<float>::infinity();
};

struct Hit {
  float t = std::numeric_limits<float>::infinity();
  uint32_t object = 0xffffffffu;  // index into RenderScene::objects
  uint32_t triangle = 0;          // within the object
  float u = 0.0f, v = 0.0f;       // weights of the second and third vertex

  explicit operator bool() const { return object != 0xffffffffu; }
};

// Which surfaces a ray can hit: all, or only those that a camera sees (RenderScene::backIsUnseen).
enum class Surfaces { all, seen };

class RayCaster {
 public:
  // Keeps a reference: the scene must outlive this object. Throws std::bad_alloc, or
  // std::runtime_error with Embree's message, as update() does. After that only `rebuilt` is valid.
  explicit RayCaster(const RenderScene& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // Call this after the scene was updated. Refits moved objects, inserts added ones and deletes
  // removed ones; `rebuilt` rebuilds everything.
  void update(const RenderSceneChanges& changes);

  Hit intersect(const Ray& ray, Surfaces which = Surfaces::all) const;
  bool occluded(const Ray& ray) const;
  static constexpr size_t kLanes = 8;  // rays that are traced together
  // Eight rays; tFar < 0 disables a lane, which is not occluded then. Fastest for coherent rays.
  std::array<bool, kLanes> occluded8(std::span<const Ray, kLanes> rays) const;
  // Traces eight rays; tFar < 0 disables a lane. Fastest for coherent rays (similar origins or
  // directions).
  void intersect8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits,
                  Surfaces which = Surfaces::all) const;
  // Like intersect8(), but of all triangles that are equally near within rounding, also where
  // surfaces coincide, it takes the one with the least distance, then with the least object and
  // triangle. So hits do not depend on the tree.
  void leastHits8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits) const;
  // Only distances, infinity for a miss: the least one of all triangles that are equally near
  // within rounding. So they do not depend on the tree, not even where surfaces coincide.
  void distance8(std::span<const Ray, 8> rays, std::span<float, 8> distances) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Whether a ray with this direction hits the back of the triangle.
bool isOnBack(const RenderScene& scene, const Hit& hit, const vec3& direction);

// Conservative test whether the ray segment touches the box.
bool mayTouch(const Ray& ray, const Bounds& box);

// Offset [m] for rays that leave a surface, so that they do not hit it again. Proportional to the
// magnitude of the coordinates (float spacing).
float rayEpsilon(const vec3& position);

}  // namespace lamplighter
