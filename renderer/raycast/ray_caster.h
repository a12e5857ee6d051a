// The only wrapper of Embree: world-space rays against a RenderScene. Alpha masks are tested;
// clear (transmissive) materials are not in it. The same bits at any number of threads and on every
// x86-64-v3 processor: one fixed instruction set, and distances and barycentrics computed from the
// triangle (triangle_hit.h). Which of two triangles is hit where both are equally far, as at a
// shared edge, is left to Embree and may differ between processors.
#pragma once

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

// What a ray meets: all surfaces, or those that a camera sees (RenderScene::backIsUnseen).
enum class Surfaces { all, seen };

class RayCaster {
 public:
  explicit RayCaster(const RenderScene& scene);  // keeps a reference: the scene must outlive it
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  // After the scene was updated. Moved objects alone are refreshed; `rebuilt` builds anew.
  void update(const RenderSceneChanges& changes);

  Hit intersect(const Ray& ray, Surfaces which = Surfaces::all) const;
  bool occluded(const Ray& ray) const;
  // Eight rays at a time; tFar < 0 switches a lane off. Fastest where they start or go alike.
  void intersect8(std::span<const Ray, 8> rays, std::span<Hit, 8> hits,
                  Surfaces which = Surfaces::all) const;
  // Their distances alone; infinity where nothing is hit. A little faster.
  void distance8(std::span<const Ray, 8> rays, std::span<float, 8> distances) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Whether the ray up to its end touches the box, or nearly.
bool mayTouch(const Ray& ray, const Bounds& box);

// A distance to leave a surface by, so that a ray does not hit it again: proportional to the
// magnitude of the coordinates (float spacing), in metres.
float rayEpsilon(const vec3& position);

}  // namespace lamplighter
