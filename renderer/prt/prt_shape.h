// The properties of an object that determine its transfer, independent of position and rotation.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

struct PrtShape {
  bool mayHaveTransfer = false;  // if false, the other members are meaningless
  mat3 stretch{1.0f};            // as in OwnSpace
  int points = 0;                // number of light points
  std::vector<int> looseRoots;   // root patches that are in no chart
  std::vector<bool> isLoose;     // by triangle: it is in one of these patches
  bool operator==(const PrtShape&) const = default;
};

// `mostPoints`: upper bound of the number of light points. A mesh may have transfer if it is mostly
// complex, is shaded with vertex normals, and is neither emissive nor clear.
PrtShape prtShapeOf(const RenderScene& scene, uint32_t object, const ObjectPatches& patches,
                    int mostPoints);

}  // namespace lamplighter
