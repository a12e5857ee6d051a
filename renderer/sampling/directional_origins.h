// Where paths of parallel light (a sun, one direction of the sky) cross the level: more of them
// where the level has its detail, so that a room in a wide landscape gets its share.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/base/alias_table.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

class DirectionalOrigins {
 public:
  DirectionalOrigins() = default;
  DirectionalOrigins(const RenderScene& scene, const vec3& centre, float radius);

  struct Point {
    vec3 position{0.0f};  // on the plane through the scene's middle across the direction
    float pdf = 0.0f;     // 1/m² on that plane
  };
  // `towards`: unit, against the light's way. u: two numbers for the place, v: one for the choice.
  Point sample(const vec3& towards, vec2 u, float v) const;

 private:
  // A ball round each object; seen along any direction it is a disc.
  struct Ball {
    vec3 centre{0.0f};
    float radius = 0.0f;
  };
  float pdfAt(const vec3& position, const vec3& towards, size_t chosen) const;

  Ball whole_;
  std::vector<Ball> balls_;
  AliasTable choice_;  // by triangles: a measure of detail
};

}  // namespace lamplighter
