// Finds the faster backend on this machine by a trial.
#pragma once

#include <memory>

#include "renderer/backends/backend.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct BackendTrial {
  double cpuSeconds = 0.0, glSeconds = 0.0;  // one frame of the trial scene
};

// Renders a small built-in scene with both backends (a tenth of a second on two cores) and returns
// the time of each. Each is warmed up first, so that the times do not include shader compilation.
BackendTrial tryBackends(Backend& cpu, Backend& gl, const Stopwatch& stopwatch);

// The faster backend. Needs a current OpenGL context; without one use makeCpuBackend().
std::unique_ptr<Backend> chooseBackend(const Stopwatch& stopwatch, BackendTrial* trial = nullptr);

}  // namespace lamplighter
