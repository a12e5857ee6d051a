// The cpu backend: rasterises triangles in tiles, traces shadow maps with Embree, and sums light
// eight pixels at a time. It needs no OpenGL and gives the same bits at any number of threads on
// every x86-64-v3 machine.
#pragma once

#include <memory>

#include "renderer/backends/kernels.h"

namespace lamplighter {

std::unique_ptr<Backend> makeCpuBackend();

}  // namespace lamplighter
