// What an object's transfer follows from, wherever it stands and however it is turned.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

struct PrtShape {
  bool mayHaveTransfer = false;  // else the rest says nothing
  mat3 stretch{1.0f};            // of OwnSpace
  int points = 0;                // light points
  std::vector<int> looseRoots;   // patches in no chart
  std::vector<bool> isLoose;     // by triangle: it lies in one of these
  bool operator==(const PrtShape&) const = default;
};

// `mostPoints`: of light points. Meshes may have transfer that are complex for the most part, shade
// by the normals of their vertices, and neither glow nor are clear.
PrtShape prtShapeOf(const RenderScene& scene, uint32_t object, const ObjectPatches& patches,
                    int mostPoints);

}  // namespace lamplighter
