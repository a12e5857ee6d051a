// Methods whose settled pictures are repaired by paths of the reference.
#pragma once

#include "renderer/base/parameter_table.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct RepairParameters {
  int repair = 256;  // paths for each pixel; used only if the caller allows refinement
};
const ParameterTable<RepairParameters>& repairParameters();

// The method with repair added: its parameter, statistics and stage come after those of the method.
// The method must have the parameters of PathParameters and SurfaceParameters, and show all light
// that the path tracer finds with them.
MethodInfo repaired(MethodInfo method);

}  // namespace lamplighter
