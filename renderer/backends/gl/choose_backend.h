// Which backend is the faster on this machine, by trying.
#pragma once

#include <memory>

#include "renderer/backends/kernels.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct BackendTrial {
  double cpuSeconds = 0.0, glSeconds = 0.0;  // a frame of the trial scene each
};

// Renders a small scene, made here, with both backends (a tenth of a second on two cores) and
// returns how long each took. Each is warmed up first, so that shader builds do not count.
BackendTrial tryBackends(Backend& cpu, Backend& gl, const Stopwatch& stopwatch);

// The faster backend. An OpenGL context must be current; where there is none use makeCpuBackend().
std::unique_ptr<Backend> chooseBackend(const Stopwatch& stopwatch, BackendTrial* trial = nullptr);

}  // namespace lamplighter
