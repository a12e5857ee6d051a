// Every method by name.
#pragma once

#include <string>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// In the order they are shown.
const std::vector<MethodInfo>& methods();
// Throws InputError when there is none of that name.
const MethodInfo& findMethod(const std::string& name);

}  // namespace lamplighter
