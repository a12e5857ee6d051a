// Precomputed radiance transfer of one object (paper 1, 4.4.1, after Sloan, Kautz and Snyder,
// "Precomputed Radiance Transfer for Real-Time Rendering in Dynamic, Low-Frequency Lighting
// Environments", 2002). For each vertex it maps distant incident light to irradiance, with the
// shadows of the object on itself and the interreflection between its parts. Unlike in the paper,
// it has colour.
//
// It is computed in the object's own space (own_space.h), so translation, rotation and uniform
// scale do not change it; only a stretch does.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/prt/spherical_harmonics.h"
#include "renderer/scene/own_space.h"

namespace lamplighter {

// A scene that contains only the object, in its own space. The transfer depends only on it. It has
// the same bits for every position and rotation of the object.
RenderScene ownSceneOf(const RenderScene& scene, uint32_t object, const OwnSpace& space);

struct TransferOptions {
  int directions = 256;  // rays per vertex
  int bounces = 2;       // interreflections between parts of the object; 0: shadows only
  bool operator==(const TransferOptions&) const = default;
};

// For each vertex: the dot product with the coefficients of incident radiance [W/(m² sr)] is the
// irradiance [W/m²] on the front side of its shading normal, per channel.
struct Transfer {
  struct Vertex {
    ShVector r{}, g{}, b{};
    ShVector direct{};  // the part without interreflection
    bool operator==(const Vertex&) const = default;
  };
  std::vector<Vertex> vertices;
  bool operator==(const Transfer&) const = default;
};

// Shared between threads during the computation.
struct TransferProgress {
  std::atomic<uint64_t> done{0};  // vertices, counted once per pass
  std::atomic<uint64_t> total{1};
  std::atomic<bool> isCancelled{false};
};

// `own`: from ownSceneOf(). Vertices that no triangle uses get the transfer of an unshadowed plane.
// Back faces block light and reflect none. The bits do not depend on the number of threads. None if
// it was cancelled.
std::optional<Transfer> computeTransfer(const RenderScene& own, const TransferOptions& options,
                                        TransferProgress* progress = nullptr);

}  // namespace lamplighter
