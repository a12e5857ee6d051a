#include "ui/app/backends.h"

#include <spdlog/spdlog.h>

#include "editor/notices/failure_text.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/choose_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/error.h"
#include "renderer/gl/headless_context.h"

namespace lamplighter {

std::unique_ptr<Backend> makeBackend(const std::string& kind, const Stopwatch& stopwatch) {
  if (kind == "cpu") return makeCpuBackend();
  if (kind == "gl") return makeGlBackend();
  try {
    return chooseBackend(stopwatch);
  } catch (const std::exception& e) {
    spdlog::warn("the gl backend does not work here, so cpu is used: {}", failureText(e));
    return makeCpuBackend();
  }
}

std::unique_ptr<Backend> makeHeadlessBackend(const std::string& kind, const Stopwatch& stopwatch) {
  if (kind == "cpu") return makeCpuBackend();
  std::unique_ptr<gl::HeadlessContext> context;
  try {
    context = std::make_unique<gl::HeadlessContext>();
  } catch (const InputError&) {
    if (kind == "gl") throw;
    return makeCpuBackend();
  }
  if (kind != "gl" && makeBackend(kind, stopwatch)->info().name == "cpu") return makeCpuBackend();
  return makeGlBackend(std::move(context));
}

}  // namespace lamplighter
