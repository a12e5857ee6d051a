// The method of paper 3, "Coherent surface shadow maps": see README.md.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo surfaceShadowMapsInfo();

}  // namespace lamplighter
