// The point of a triangle that a pixel shows.
#pragma once

#include <algorithm>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Weights of the second and third vertex of the triangle that a pixel shows.
struct SeenTriangle {
  vec2 weights{0.0f};
  bool isBack = false, isSound = false;

  SeenTriangle(const RenderScene& scene, const GBufferPoint& p) {
    const uint32_t* i = &scene.indices[scene.objects[p.object].firstIndex + 3 * p.triangle];
    const vec3& a = scene.positions[i[0]];
    const vec3 ab = scene.positions[i[1]] - a, ac = scene.positions[i[2]] - a;
    const vec3 cross = glm::cross(ab, ac), d = p.position - a;
    const float area2 = glm::dot(cross, cross);
    isSound = area2 > 0.0f;
    if (!isSound) return;
    weights.x = std::clamp(glm::dot(glm::cross(d, ac), cross) / area2, 0.0f, 1.0f);
    weights.y = std::clamp(glm::dot(glm::cross(ab, d), cross) / area2, 0.0f, 1.0f - weights.x);
    isBack = glm::dot(cross, p.geometricNormal) < 0.0f;
  }
};

}  // namespace lamplighter
