// Clusters: neighbouring small triangles that face similar directions share one sample.
#pragma once

#include <span>

#include "renderer/surface_light/own_mesh.h"
#include "renderer/surface_light/surface_shape.h"

namespace lamplighter {

// Adds clusters of about `size` [m] for these triangles, on each side that the shape has, and the
// values at their vertices. A vertex that has a sample of the trees uses that.
void addClusters(const OwnMesh& mesh, std::span<const uint32_t> triangles, float size,
                 SampleKeys& keys, SurfaceShape& out);

}  // namespace lamplighter
