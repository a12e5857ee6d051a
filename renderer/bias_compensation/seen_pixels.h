// The surfaces that the camera sees in eight neighbouring pixels of a row.
#pragma once

#include <array>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct SeenPixels {
  static constexpr int kCount = 8;

  // The pixels from x0 on, shifted by `jitter`; those beyond the picture see nothing.
  SeenPixels(const RayCaster& caster, const View& view, vec2 jitter, int x0, int y) {
    for (int i = 0; i < kCount; ++i) {
      const vec2 at = vec2(x0 + i, y) + 0.5f + jitter;
      const vec3 direction = view.rayDirection(at.x, at.y);
      rays[i] = {view.eye, view.znear / glm::dot(direction, view.forward()), direction};
      if (x0 + i >= view.width) rays[i].tFar = -1.0f;
    }
    caster.intersect8(rays, hits, Surfaces::seen);
  }

  std::array<Ray, kCount> rays;
  std::array<Hit, kCount> hits;
};

}  // namespace lamplighter
