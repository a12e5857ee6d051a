// Lights near each other that look the same way, so that what may stand between them and a patch is
// looked for once (paper 1, 6.2: "a larger bounding shape").
#pragma once

#include <span>
#include <vector>

#include "shaders/shared/vpl.h"

namespace lamplighter {

struct LightClusters {
  std::vector<int> order;      // all slots, those of a cluster one after the other
  std::vector<int> clusterOf;  // by slot; −1: in none (parallel lights, empty slots)
};

// At most 16 lights within 2 m of each other, whose normals have the same greatest component.
LightClusters clusterLights(std::span<const shared::Vpl> bySlot);

}  // namespace lamplighter
