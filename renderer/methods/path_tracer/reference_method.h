// The path tracer as a method, so that comparisons need no special case.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

inline constexpr char kReferenceMethod[] = "reference";

MethodInfo referenceInfo();

}  // namespace lamplighter
