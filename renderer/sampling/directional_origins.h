// Samples where paths of parallel light (a sun, one direction of the sky) enter the level. Detailed
// parts of the level get more paths, so that a room in a wide landscape gets enough.
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
    vec3 position{0.0f};  // on the plane through the centre of the scene, perpendicular to the
                          // direction
    float pdf = 0.0f;     // 1/m² on that plane
  };
  // `towards`: unit, towards the light. u selects the position, v the ball.
  Point sample(const vec3& towards, vec2 u, float v) const;

 private:
  // A bounding sphere of each object; its projection along any direction is a disc.
  struct Ball {
    vec3 centre{0.0f};
    float radius = 0.0f;
  };
  float pdfAt(const vec3& position, const vec3& towards, size_t chosen) const;

  Ball whole_;
  std::vector<Ball> balls_;
  AliasTable choice_;  // by number of triangles: a measure of detail
};

}  // namespace lamplighter
