// Adds repair by paths of the reference to methods.
#pragma once

#include "renderer/base/parameter_table.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct RepairParameters {
  int repair = 256;  // paths per pixel; used only if the caller allows refinement
};
const ParameterTable<RepairParameters>& repairParameters();

// Returns the method with repair added: the parameter, statistics and stage of repair follow those
// of the method. The method must have PathParameters and SurfaceParameters, and must show all light
// that the path tracer computes with them.
MethodInfo repaired(MethodInfo method);

}  // namespace lamplighter
