// The path tracer as a method like the others, so that comparing with it needs no special case.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

MethodInfo referenceInfo();

}  // namespace lamplighter
