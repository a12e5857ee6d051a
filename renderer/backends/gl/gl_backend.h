// The gl backend: rasterised G-buffer and shadow maps, light sums in fragment shaders. OpenGL 4.5
// core, nothing of any vendor's.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/backends/kernels.h"
#include "renderer/gl/headless_context.h"
#include "renderer/gl/shader_source.h"

namespace lamplighter {

// A context must be current, then and at each later call (pictures that it hands out included, down
// to their end). Throws gl::ShaderError.
std::unique_ptr<Backend> makeGlBackend(
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// The same with a context of its own, which stays current on this thread.
std::unique_ptr<Backend> makeGlBackend(
    std::unique_ptr<gl::HeadlessContext> context,
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// Compiles the shaders anew; throws gl::ShaderError when they are broken (what was good stays in
// use). Does nothing to other backends.
void reloadShaders(Backend& backend, const std::filesystem::path& shaders);

}  // namespace lamplighter
