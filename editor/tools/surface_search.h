// The surface, or its corner, that a ray of the camera meets first among what may be met.
#pragma once

#include <optional>
#include <vector>

#include "editor/document/document.h"
#include "editor/edits/placement.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct SurfaceSearch {
  const Document& document;
  const RenderScene& scene;
  const RayCaster& rays;
  const std::vector<NodeId>& ignored;  // and all that hangs below them

  // The nearest surface along a unit direction from `eye`; none: nothing is there.
  std::optional<SurfacePoint> along(const vec3& eye, const vec3& direction) const;
  // The corner of the triangle under the pointer that is nearest to it in the picture.
  std::optional<vec3> vertexAt(const View& view, const vec2& pointer) const;

 private:
  std::optional<Hit> hitAlong(const vec3& eye, const vec3& direction) const;
  bool isIgnored(NodeId id) const;
};

}  // namespace lamplighter
