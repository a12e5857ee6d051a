// The kernels of all methods on the cpu backend.
#include "renderer/backends/cpu/many_lights/cpu_many_lights.h"

namespace lamplighter::cpu {

void offerKernels(CpuBackend& backend) {
  backend.offer<ManyLightsKernels>([&] { return makeManyLightsKernels(backend); });
}

}  // namespace lamplighter::cpu
