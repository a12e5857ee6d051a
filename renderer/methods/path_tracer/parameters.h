// The parameters of the path tracer as a method.
#pragma once

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/path_tracer/path_tracer.h"

namespace lamplighter {

struct PathTracerParameters : PathParameters, SampleParameters, SurfaceParameters {
  bool glossyBounces = false;

  PathTracerOptions options(bool lightOnly) const {
    return {bounces,      static_cast<uint32_t>(seed), lightOnly, speculars, leastRoughness,
            glossyBounces};
  }
};

const ParameterTable<PathTracerParameters>& pathTracerParameters();

}  // namespace lamplighter
