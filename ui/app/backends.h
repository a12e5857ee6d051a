// Which backend there is to have, and where its OpenGL comes from.
#pragma once

#include <memory>
#include <string>

#include "renderer/backends/kernels.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

// kind: "cpu", "gl" or "auto" (the faster, by a short measurement). The caller's OpenGL context is
// current and outlives the backend.
std::unique_ptr<Backend> makeBackend(const std::string& kind, const Stopwatch& stopwatch);

// The same without a window: gl gets a context of its own. Throws InputError when "gl" is asked for
// and there is none to be had; "auto" is "cpu" then.
std::unique_ptr<Backend> makeHeadlessBackend(const std::string& kind, const Stopwatch& stopwatch);

}  // namespace lamplighter
