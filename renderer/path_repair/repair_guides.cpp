#include "renderer/path_repair/repair_guides.h"

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Black surfaces reflect, too: highlights.
constexpr float kLeastAlbedo = 0.04f;

}  // namespace

RepairGuides::RepairGuides(const GBufferView& gbuffer, const View& view, bool white)
    : width(gbuffer.width()), height(gbuffer.height()) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  position.assign(pixels, vec3(0.0f));
  normal.assign(pixels, vec3(0.0f));
  albedo.assign(pixels, vec3(1.0f));
  footprint.assign(pixels, 1.0f);
  const float middle = 0.5f * static_cast<float>(height);
  const float perMetre =
      glm::distance(view.rayDirection(0.5f * static_cast<float>(width), middle + 0.5f),
                    view.rayDirection(0.5f * static_cast<float>(width), middle - 0.5f));
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      if (p.emission != vec3(0.0f)) continue;
      const auto i = static_cast<size_t>(y * width + x);
      position[i] = p.position;
      normal[i] = p.normal;
      if (!white) albedo[i] = glm::max(p.albedo, vec3(kLeastAlbedo));
      footprint[i] = perMetre * glm::distance(p.position, view.eye);
    }
  });
}

}  // namespace lamplighter
