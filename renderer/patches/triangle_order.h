// The order of the triangles of a mesh once its charts are known.
#pragma once

#include "renderer/patches/mesh_shape.h"
#include "renderer/patches/topology.h"

namespace lamplighter {

// Sorts `out.loose` into the order of a tree that splits at the median of the triangles' centres
// along the longest axis, and makes `out.clusters` of its first levels. Clusters of more than 1,024
// triangles and larger than `smallest` [m] are halved. Works in parallel; the result does not
// depend on it.
void sortLoose(const MeshShape& shape, float smallest, MeshTopology& out);

// Sets `out.flat`, and `out.occluders` to the tree for occluder searches: triangles of charts one
// by one, loose triangles in groups.
void addOccluders(const MeshShape& shape, MeshTopology& out);

}  // namespace lamplighter
