// Points on the surfaces of a scene, uniform by area: where virtual lights, imperfect shadow maps
// (Ritschel et al. 2008) or probes sample the geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct SampledPoint {
  uint32_t object = 0, triangle = 0;  // index into RenderScene::objects; within the object
  float u = 0.0f, v = 0.0f;           // weights of the second and third vertex
};

// A piecewise constant distribution over all triangles that rays can hit: all objects except clear
// (transmissive) ones. Holes of alpha masks are not cut out (alphaAt).
class SurfaceSampler {
 public:
  SurfaceSampler() = default;
  explicit SurfaceSampler(const RenderScene& scene);

  // Computes only the areas of moved objects again. The result is equal to that of the constructor.
  void update(const RenderScene& scene, const RenderSceneChanges& changes);

  double area() const { return ends_.empty() ? 0.0 : ends_.back(); }  // [m²]
  // The point depends only on the scene and the arguments. Any aligned block of 2ᵏ consecutive
  // indices is stratified: each of 2ᵏ parts of equal area gets one point. Call it only if area() is
  // not 0.
  SampledPoint at(uint32_t index, uint32_t seed) const;

 private:
  std::vector<std::vector<double>> triangleEnds_;  // by object: running sum of the areas [m²]
  std::vector<double> ends_;                       // running sum over the objects [m²]

  void measure(const RenderScene& scene, size_t object);
  void sum(const RenderScene& scene);
};

}  // namespace lamplighter
