// The kernels of many_lights on the cpu backend: traces shadow maps with Embree and sums light
// eight pixels at a time.
#pragma once

#include <memory>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/many_lights_kernels.h"

namespace lamplighter::cpu {

std::unique_ptr<ManyLightsKernels> makeManyLightsKernels(CpuBackend& backend);

}  // namespace lamplighter::cpu
