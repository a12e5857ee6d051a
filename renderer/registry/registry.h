// All methods by name.
#pragma once

#include <deque>
#include <string>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

// In the order of the user interface. References stay valid.
const std::deque<MethodInfo>& methods();
// Throws InputError if there is no method of that name.
const MethodInfo& findMethod(const std::string& name);

// "multi_mesh, or many_lights with indirect=meshes"; "": no method.
std::string methodsThatShow(Capability capability);

// Adds a method of a library that the renderer does not link, such as renderer_gl. For the start of
// the program, before other threads and before the first use of the list. Throws std::logic_error
// if the name is taken.
void addMethod(MethodInfo method);

// Why the method does not run on the backend; "": it does.
std::string problemOf(const MethodInfo& method, const Backend& backend);
// The method of that name. Throws InputError if there is none, or if it does not run on the
// backend.
const MethodInfo& runnableMethod(const std::string& name, const Backend& backend);

}  // namespace lamplighter
