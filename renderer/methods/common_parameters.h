// Parameters that several methods use. The parameter struct of a method derives from those that it
// uses, and its table contains their tables.
#pragma once

#include <optional>

#include "renderer/base/parameter_table.h"

namespace lamplighter {

// For methods that use random numbers.
struct SeedParameters {
  int seed = 1;
  bool operator==(const SeedParameters&) const = default;
};
const ParameterTable<SeedParameters>& seedParameters();

// For methods that trace light paths.
struct PathParameters : SeedParameters {
  int bounces = 2;  // indirect; 0: direct light only
  bool operator==(const PathParameters&) const = default;
};
const ParameterTable<PathParameters>& pathParameters();

// Reflection model of surfaces that the camera sees.
struct SurfaceParameters {
  bool speculars = true;  // metallic-roughness BRDF
  float leastRoughness = 0.1f;
  bool operator==(const SurfaceParameters&) const = default;
};
const ParameterTable<SurfaceParameters>& surfaceParameters();

// For methods that trace a given number of paths per pixel.
struct SampleParameters {
  int samplesPerPixel = 64;
  int samplesPerFrame = 1;  // per pixel
  bool operator==(const SampleParameters&) const = default;
};
const ParameterTable<SampleParameters>& sampleParameters();

// For methods that spread the work of an edit over frames. The editor sets `updates` from the
// measured times of earlier frames.
struct FrameBudgetParameters {
  int updates = 100;
  float frameTime = 50.0f;  // [ms]; used only in the editor's window
  bool operator==(const FrameBudgetParameters&) const = default;
};
const ParameterTable<FrameBudgetParameters>& frameBudgetParameters();
inline constexpr char kUpdates[] = "updates";  // the name of that parameter

// Work on light on surfaces, as a share of the usual work of a frame: FrameBudget::surfaceWork if
// the window sets it, otherwise in proportion to the parameter `updates`.
inline float surfacePace(std::optional<float> ofWindow, int updates) {
  return ofWindow.value_or(static_cast<float>(updates) /
                           static_cast<float>(FrameBudgetParameters().updates));
}

}  // namespace lamplighter
