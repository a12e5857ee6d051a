// The gl backend: rasterised G-buffer and shadow maps, light sums in fragment shaders. OpenGL 4.5
// core without vendor extensions.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/backends/kernels.h"
#include "renderer/gl/headless_context.h"
#include "renderer/gl/shader_source.h"

namespace lamplighter {

// Needs a current context, now and at each later call, including the destruction of the pictures
// that it returned. Throws gl::ShaderError.
std::unique_ptr<Backend> makeGlBackend(
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// The same with its own context, which stays current on this thread.
std::unique_ptr<Backend> makeGlBackend(
    std::unique_ptr<gl::HeadlessContext> context,
    const std::filesystem::path& shaders = gl::defaultShaderFolder());

// Compiles the shaders again. Throws gl::ShaderError if they have errors; then the previous ones
// stay in use. Does nothing to other backends.
void reloadShaders(Backend& backend, const std::filesystem::path& shaders);

}  // namespace lamplighter
