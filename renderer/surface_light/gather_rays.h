// Rays that gather light at a point of a surface: what each of them sees, and which of them an edit
// may have changed.
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

// What a ray from a surface sees. No hit: the sky.
GatherLink linkTo(const GatherScene& scene, const Hit& hit, const Ray& ray);

// Traces the rays whose bit in `wanted` is set and keeps what they see in `links`. Ray i leaves
// from spot i modulo their number. Returns the number of rays.
uint64_t traceGatherRays(const GatherScene& scene, std::span<const SurfaceSpot> spots,
                         std::span<const vec3> directions, std::span<const uint64_t> wanted,
                         std::span<GatherLink> links);

// Marks the rays first, first + step, ... that touch one of the boxes, or end on an element that a
// wall may cut otherwise than before (CutLeaves::mayDiffer).
void markTouched(const GatherScene& scene, const SurfaceSpot& spot, std::span<const Bounds> boxes,
                 std::span<const vec3> directions, std::span<const GatherLink> links, size_t first,
                 size_t step, std::span<uint64_t> marks);

}  // namespace lamplighter
