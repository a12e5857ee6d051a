// All methods by name.
#pragma once

#include <string>
#include <vector>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// In the order of the user interface.
const std::vector<MethodInfo>& methods();
// Throws InputError if there is no method of that name.
const MethodInfo& findMethod(const std::string& name);

}  // namespace lamplighter
