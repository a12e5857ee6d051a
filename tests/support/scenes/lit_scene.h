// A scene uploaded to a backend, for tests of kernels.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/many_lights_kernels.h"
#include "renderer/frame/frame.h"

namespace lamplighter::test {

struct LitScene {
  // Uses the cpu backend by default.
  explicit LitScene(const Scene& scene, std::unique_ptr<Backend> on = makeCpuBackend());

  // The picture lit by only these VPLs, with or without their shadow maps.
  Image sum(std::vector<shared::Vpl> vpls, const View& view, int resolution, bool shadows = true,
            float clampDistance = 0.0f, float bias = 0.002f);

  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  std::unique_ptr<Backend> backend;
  ManyLightsKernels* kernels = nullptr;  // of the backend
};

// A VPL of intensity 1. Its frame is rotated by `angle` around its axis.
shared::Vpl makeVpl(const vec3& position, const vec3& normal, float kind = shared::kVplCosine,
                    float angle = 0.3f);

// Renders frames until the picture is settled. Fails the test after `limit` frames.
GiOutput renderSettled(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                       const View& view, const Settings& settings, int limit = 1000);

// The settled picture of renderSettled().
Image settledPicture(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                     const View& view, const Settings& settings);
// The settled picture of a new renderer.
Image freshPicture(std::unique_ptr<Backend> backend, const Scene& scene, const View& view,
                   const Settings& settings);

// Counters of the sums and maps of many_lights; zero if it has not run.
ManyLightsCounts lightCounts(Backend& backend);

bool sameBits(const Image& a, const Image& b);

}  // namespace lamplighter::test
