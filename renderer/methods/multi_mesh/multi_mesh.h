// The method of paper 4: light that is stored on the surfaces.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo multiMeshInfo();

}  // namespace lamplighter
