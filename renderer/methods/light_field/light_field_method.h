// The method of paper 5, the virtual light field on the GPU: see
// README.md.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo lightFieldInfo();

}  // namespace lamplighter
