// Gather rays at a point of a surface: their hits, and which of them an edit may have changed.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_light/gather_links.h"

namespace lamplighter {

struct GatherScene {
  const RenderScene& scene;
  const RayCaster& rays;
  const SurfaceMesh& mesh;
  const CutLeaves& cuts;
};

// The link for the hit of a ray from a surface. No hit: the sky.
GatherLink linkTo(const GatherScene& scene, const Hit& hit, const Ray& ray);

// Traces the rays whose bit in `wanted` is set and stores their hits in `links`. Ray i starts at
// spot i modulo the number of spots. Returns the number of rays.
uint64_t traceGatherRays(const GatherScene& scene, std::span<const SurfaceSpot> spots,
                         std::span<const vec3> directions, std::span<const uint64_t> wanted,
                         std::span<GatherLink> links);

// Marks the rays first, first + step, ... that touch one of the boxes, or end on an element whose
// cut by a wall may have changed (CutLeaves::mayDiffer).
void markTouched(const GatherScene& scene, const SurfaceSpot& spot, std::span<const Bounds> boxes,
                 std::span<const vec3> directions, std::span<const GatherLink> links, size_t first,
                 size_t step, std::span<uint64_t> marks);

}  // namespace lamplighter
