#include <iostream>
#include <memory>

#include <benchmark/benchmark.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/error.h"
#include "tests/tools/bench/backend_benches.h"

int main(int argc, char** argv) {
  using namespace lamplighter;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  addNaiveBenchmarks("cpu", makeCpuBackend);
  addTechniqueBenchmarks("cpu", makeCpuBackend);
  addSpecularBenchmarks("cpu", makeCpuBackend);
  addFigureBenchmarks("cpu", makeCpuBackend);
  std::unique_ptr<gl::HeadlessContext> context;
  try {
    context = std::make_unique<gl::HeadlessContext>();
    benchmark::AddCustomContext("OpenGL", context->renderer());
    addNaiveBenchmarks("gl", [] { return makeGlBackend(); });
    addTechniqueBenchmarks("gl", [] { return makeGlBackend(); });
    addSpecularBenchmarks("gl", [] { return makeGlBackend(); });
    addFigureBenchmarks("gl", [] { return makeGlBackend(); });
  } catch (const InputError& error) {
    std::cerr << "without the gl backend: " << error.what() << "\n";
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
