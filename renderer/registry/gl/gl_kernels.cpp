// The kernels of all methods on the gl backend.
#include "renderer/backends/gl/many_lights/gl_many_lights.h"

namespace lamplighter::gl {

void offerKernels(GlBackend& backend) {
  backend.offer<ManyLightsKernels>([&] { return makeManyLightsKernels(backend); });
}

}  // namespace lamplighter::gl
