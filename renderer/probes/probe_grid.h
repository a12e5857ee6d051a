// Automatic placement of light probes: a regular grid anchored in the world, with the state of each
// place by rays. Lengths are in the unit of the scene (RenderScene::unit).
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

struct ProbeGridOptions {
  float spacing = 1.0f;   // between neighbours, along each axis
  float padding = 0.25f;  // least distance to surfaces
  int most = 32768;       // of all places; the spacing is larger if there would be more

  bool operator==(const ProbeGridOptions&) const = default;
};

enum class ProbeState : uint8_t {
  valid,
  inside,   // of a wall or an object, or behind the walls of a level
  near,     // nearer to a surface than the padding, without a better place within reach
  outside,  // no part of the level is visible from it
  dark      // beside the level, where no light arrives
};
inline constexpr int kProbeStates = 5;

struct Probe {
  vec3 position{0.0f};  // world space; moved from its node by at most half the spacing on each axis
  ProbeState state = ProbeState::outside;
  float open = 1.0f;    // share of the rays from there that hit nothing
  float behind = 0.0f;  // share that hits back faces, also of double-sided surfaces
  bool isValid() const { return state == ProbeState::valid; }
};

// Nodes at integer multiples of the spacing in the world, so that they do not move when the bounds
// change.
struct ProbeGrid {
  glm::ivec3 first{0};        // of the node with index 0, in multiples of the spacing
  glm::ivec3 size{0};         // nodes along x, y and z
  float spacing = 0.0f;       // at least that of the options
  std::vector<Probe> probes;  // x varies fastest, then y, then z
  bool isCoarser = false;     // than the options request, because of their limit

  size_t indexOf(const glm::ivec3& node) const {
    return (static_cast<size_t>(node.z) * static_cast<size_t>(size.y) +
            static_cast<size_t>(node.y)) *
               static_cast<size_t>(size.x) +
           static_cast<size_t>(node.x);
  }
  glm::ivec3 nodeAt(size_t index) const;
  vec3 placeOf(const glm::ivec3& node) const { return spacing * vec3(first + node); }
  size_t count(ProbeState state) const;
};

// The nodes in the bounds of the scene, and those around them that are at most half a spacing away
// along each axis; none of them is placed yet. No bounds: no nodes.
ProbeGrid probeNodes(const Bounds& bounds, const ProbeGridOptions& options);

// Finds the place and the state of one node by 64 rays, and 64 rays from each place that is tried.
//
// A back hit is a ray that first meets the back of a surface whose back no camera sees
// (RenderScene::backIsUnseen), without a front in the same place; other hits are front hits.
// A place is
// - outside, if it is beside or below the bounds of the level; or if no ray has a front hit and at
//   most a quarter of them have back hits: they miss;
// - else inside, if more than a quarter of the hits are back hits, or a back is within the padding
//   and nearer than all fronts;
// - else near, if a front is within the padding; else valid.
// A node beside the level is tried in it instead, if that is within half the spacing.
// A node that is near or inside is tried on both sides of up to three surfaces within the padding
// that meet at an angle, at the distance of the padding from them; of valid places the one is taken
// from which fewest rays meet nothing, so that a node in a wall belongs to the room. Otherwise, and
// from there, it is tried beyond the nearest back, or further away from the nearest front. A few
// such steps are made, as long as they stay within half the spacing of the node along each axis. If
// no place is valid, the node has its own place and state.
//
// State `dark` is not found here: see markUnlit() in probe_light.h. Deterministic.
Probe placedProbe(const RenderScene& scene, const RayCaster& rays, const ProbeGrid& grid,
                  const glm::ivec3& node, float padding);

// All nodes in parallel. The result does not depend on the number of threads.
ProbeGrid placeProbes(const RenderScene& scene, const RayCaster& rays,
                      const ProbeGridOptions& options);

}  // namespace lamplighter
