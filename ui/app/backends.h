// Creates backends and their OpenGL contexts.
#pragma once

#include <memory>
#include <string>

#include "renderer/backends/backend.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

// kind: "cpu", "gl" or "auto" (chooses the faster one by a short measurement). The caller's OpenGL
// context must be current and outlive the backend.
std::unique_ptr<Backend> makeBackend(const std::string& kind, const Stopwatch& stopwatch);

// Creates a backend without a window: gl gets its own context. Throws InputError if "gl" is
// requested and no context can be created; "auto" then chooses "cpu".
std::unique_ptr<Backend> makeHeadlessBackend(const std::string& kind, const Stopwatch& stopwatch);

}  // namespace lamplighter
