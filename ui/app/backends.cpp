#include "ui/app/backends.h"

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/error.h"

namespace lamplighter {

std::unique_ptr<Backend> makeBackend(const std::string& kind, bool) {
  if (kind == "gl") throw InputError("--backend gl: this build has no gl backend; use cpu");
  return makeCpuBackend();
}

}  // namespace lamplighter
