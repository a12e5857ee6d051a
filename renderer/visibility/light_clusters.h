// Clusters of lights that are close to each other and have similar normals. Possible occluders
// between a cluster and a patch are searched once for the whole cluster (paper 1, 6.2: "a larger
// bounding shape").
#pragma once

#include <span>
#include <vector>

#include "shaders/shared/vpl.h"

namespace lamplighter {

struct LightClusters {
  std::vector<int> order;      // all slots; those of a cluster are consecutive
  std::vector<int> clusterOf;  // by slot; −1: not in a cluster (parallel lights, empty slots)
};

// A cluster has at most 16 lights within 2 m of each other; their normals have the same largest
// component.
LightClusters clusterLights(std::span<const shared::Vpl> bySlot);

}  // namespace lamplighter
