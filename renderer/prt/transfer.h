// Precomputed radiance transfer of one object (paper 1, 4.4.1, after Sloan, Kautz and Snyder,
// "Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency Lighting
// Environments", 2002): for each vertex what it makes of light from afar, with the object's own
// shadows and what its parts reflect onto each other. Past the paper it has colour.
//
// In the object's own space: the world turned back and moved back with the object, so that moving
// and turning it changes nothing, and in units in which its scale keeps volumes, so that scaling
// does not either, but for how it stretches.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/prt/spherical_harmonics.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Where an object's own space is in the world: x_world = scale · rotation · x_own + translation.
struct OwnSpace {
  mat3 rotation{1.0f};
  mat3 stretch{1.0f};  // the node's space to the own one; rounded, so that turning keeps its bits
  vec3 translation{0.0f};
  float scale = 1.0f;  // not rounded [m]
};

// None where the object is flattened by its node or is not finite.
std::optional<OwnSpace> ownSpaceOf(const RenderObject& object);

// A scene with nothing but the object, in its own space: all that its transfer depends on, and
// the same bits wherever the object stands and however it is turned.
RenderScene ownSceneOf(const RenderScene& scene, uint32_t object, const OwnSpace& space);

struct TransferOptions {
  int directions = 256;  // rays a vertex
  int bounces = 2;       // of light between parts of the object; 0: shadows alone
  bool operator==(const TransferOptions&) const = default;
};

// Of each vertex the dot product with coefficients of incident radiance [W/(m² sr)] is irradiance
// [W/m²] on the front of its shading normal, channel by channel.
struct Transfer {
  struct Vertex {
    ShVector r{}, g{}, b{};
    ShVector direct{};  // the part of each of them that comes straight, without reflections
    bool operator==(const Vertex&) const = default;
  };
  std::vector<Vertex> vertices;
  bool operator==(const Transfer&) const = default;
};

// Read and set by other threads while it is computed.
struct TransferProgress {
  std::atomic<uint64_t> done{0};  // vertices, once for each pass over them
  std::atomic<uint64_t> total{1};
  std::atomic<bool> isCancelled{false};
};

// `own`: of ownSceneOf(). Vertices that no triangle uses get the transfer of an unshadowed plane.
// Back faces stop light and reflect none. The same bits at any number of threads. None when it was
// cancelled.
std::optional<Transfer> computeTransfer(const RenderScene& own, const TransferOptions& options,
                                        TransferProgress* progress = nullptr);

}  // namespace lamplighter
