// The view frustum, for conservative tests.
#pragma once

#include <array>

#include "renderer/base/math.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

class Frustum {
 public:
  Frustum() = default;
  explicit Frustum(const mat4& worldToClip) {
    const mat4 rows = glm::transpose(worldToClip);
    planes_ = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
               rows[3] - rows[2]};
  }

  bool mayMeet(const Bounds& box) const {
    const vec3 centre = box.centre(), half = 0.5f * box.extent();
    for (const vec4& p : planes_) {
      if (glm::dot(vec3(p), centre) + glm::dot(glm::abs(vec3(p)), half) + p.w < 0.0f) return false;
    }
    return true;
  }

 private:
  std::array<vec4, 5> planes_{};  // without the far plane, which is at infinity; inside is positive
};

}  // namespace lamplighter
