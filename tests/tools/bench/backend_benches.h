// Benchmarks that are registered once for each backend.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "renderer/backends/backend.h"

namespace lamplighter {

using MakeBackend = std::function<std::unique_ptr<Backend>()>;

// Adds the benchmarks of the technique `naive` on one backend.
void addNaiveBenchmarks(const std::string& backend, const MakeBackend& make);
// Adds frames of each technique on one backend.
void addTechniqueBenchmarks(const std::string& backend, const MakeBackend& make);
// Adds frames of levels with glossy materials on one backend.
void addSpecularBenchmarks(const std::string& backend, const MakeBackend& make);
// Adds the benchmarks for figures 5-3 to 5-6 of paper 1, on one backend.
void addFigureBenchmarks(const std::string& backend, const MakeBackend& make);

}  // namespace lamplighter
