#include "renderer/methods/common_parameters.h"

namespace lamplighter {

using enum ParameterGroup;

const ParameterTable<SeedParameters>& seedParameters() {
  static const ParameterTable<SeedParameters> table{
      &SeedParameters::seed,
      "seed",
      "Seed",
      "",
      "Seed of the random numbers. Another value: different noise, at the same cost.",
      {0, 1000000}};
  return table;
}

const ParameterTable<PathParameters>& pathParameters() {
  static const ParameterTable<PathParameters> table{
      {&PathParameters::bounces,
       "bounces",
       "Bounces",
       "",
       "Number of indirect bounces. More: brighter dark areas; each bounce costs work, except with "
       "light samples, whose number is fixed. 0: direct light only.",
       {0, 64},
       lightSamples},
      seedParameters().inGroup(lightSamples)};
  return table;
}

const ParameterTable<SurfaceParameters>& surfaceParameters() {
  using P = SurfaceParameters;
  static const ParameterTable<P> table{
      {&P::speculars, "speculars", "Speculars",
       "Surfaces that the camera sees reflect light by their metallic and roughness values. "
       "Bounces remain diffuse. Off: visible surfaces are diffuse, too. Costs time per glossy "
       "pixel.",
       picture},
      {&P::leastRoughness,
       "least_roughness",
       "Least roughness",
       "",
       "Minimum roughness for reflections. Smoother surfaces are shown with this roughness; a "
       "mirror would show light samples as dots. No cost in time.",
       {0.05, 1.0},
       picture}};
  return table;
}

const ParameterTable<SampleParameters>& sampleParameters() {
  using P = SampleParameters;
  static const ParameterTable<P> table{
      {&P::samplesPerPixel,
       "samples_per_pixel",
       "Paths per pixel",
       "",
       "Paths traced per pixel until the picture is settled. The total time grows in proportion.",
       {1, 1048576, kLogarithmic},
       budgets,
       "More: less noise in the settled picture; four times as many halve it."},
      {&P::samplesPerFrame,
       "samples_per_frame",
       "Paths per frame",
       "",
       "Paths traced per pixel in one frame. Higher: longer frames, fewer of them.",
       {1, 4096, kLogarithmic},
       budgets,
       "More: less noise in fewer frames, each of which takes longer."}};
  return table;
}

const ParameterTable<FrameBudgetParameters>& frameBudgetParameters() {
  using P = FrameBudgetParameters;
  static const ParameterTable<P> table{
      {&P::updates,
       kUpdates,
       "Updates per frame",
       "",
       "Maximum number of light samples that change per frame. Lower: shorter frames, but an edit "
       "takes longer to arrive.",
       {1, 65536, kLogarithmic},
       budgets,
       "More: an edit is complete in fewer frames. Fewer: each frame is shorter."},
      {&P::frameTime,
       "frame_time",
       "Frame time",
       "ms",
       "Target duration of a frame in the editor's window. Limits the refreshed light samples by "
       "their measured cost. 0: only the counts limit a frame. Recordings, replays and rendering "
       "without a window always use counts.",
       {0.0, 1000.0},
       budgets,
       "Longer: an edit is complete in fewer frames. Shorter: drags are shown more smoothly."}};
  return table;
}

}  // namespace lamplighter
