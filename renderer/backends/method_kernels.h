// The kernels of a method on one backend: work per pixel or texel that only this method has. A
// method declares their interface, derived from MethodKernels, and implements it for each backend.
#pragma once

#include <cstdint>
#include <filesystem>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Work since construction and memory in use.
struct BackendCounts {
  uint64_t rays = 0;
  uint64_t memoryBytes = 0;
  uint64_t waits = 0;  // times that the processor waited for the device (gl::Waits)
};

// The backend that owns the kernels calls these functions.
class MethodKernels {
 public:
  virtual ~MethodKernels() = default;
  // The scene changed, as in Backend::setScene(). For new kernels everything changed.
  virtual void takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                         const RayCaster& rays) = 0;
  // The G-buffer was rendered.
  virtual void takeGBuffer() {}
  // Compiles the shaders again, as gl::GlBackend::reload() does. Only on the gl backend.
  virtual void reloadShaders(const std::filesystem::path& /*folder*/) {}
  virtual BackendCounts counts() const = 0;
};

}  // namespace lamplighter
