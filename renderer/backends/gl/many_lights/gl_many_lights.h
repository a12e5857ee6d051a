// The kernels of many_lights on the gl backend: rasterised shadow maps, light sums in fragment
// shaders.
#pragma once

#include <memory>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/backends/many_lights_kernels.h"

namespace lamplighter::gl {

// Throws ShaderError.
std::unique_ptr<ManyLightsKernels> makeManyLightsKernels(GlBackend& backend);

}  // namespace lamplighter::gl
