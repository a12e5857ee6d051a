// Finds the first surface, or its vertex, on a ray of the camera. Some nodes can be ignored. All
// arguments and results are in metres.
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
  const std::vector<NodeId>& ignored;  // with all their descendants

  // The nearest surface from `eye` along a unit direction. None if the ray hits nothing.
  std::optional<SurfacePoint> along(const vec3& eye, const vec3& direction) const;
  // The vertex of the triangle under the pointer that is nearest to the pointer in the picture.
  std::optional<vec3> vertexAt(const View& view, const vec2& pointer) const;

 private:
  std::optional<Hit> hitAlong(const vec3& eye, const vec3& direction) const;
  bool isIgnored(NodeId id) const;
};

}  // namespace lamplighter
