// Which backend there is to have, and where its OpenGL comes from.
#pragma once

#include <memory>
#include <string>

#include "renderer/backends/kernels.h"

namespace lamplighter {

// kind: "cpu", "gl" or "auto". `context`: an OpenGL context is current and outlives the backend.
// Throws InputError for "gl" without one.
std::unique_ptr<Backend> makeBackend(const std::string& kind, bool context);

}  // namespace lamplighter
