// Chooses light samples among the texels of a reflective map (paper 2, sections 4.1 and 6.5).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/imperfect_maps/map_light.h"
#include "renderer/imperfect_maps/reflective_map.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct LightChoiceOptions {
  int count = 1024;
  // Share of the choice that follows the flux of texels instead of their importance, which ignores
  // occlusion. It bounds the brightness of a sample.
  float defence = 0.1f;
  uint32_t seed = 1;
  // If not null: samples lie between texels that are close to each other in this view, at the mean
  // of their positions. Null: samples lie at texels.
  const View* between = nullptr;
};

struct ChosenLights {
  std::vector<SceneVpl> lights;  // intensity I/(N·p)
  std::vector<uint32_t> texels;  // of each light
  // Share of all flux that is on texels without importance, which only the defensive share chooses.
  float defended = 0.0f;
};

// N lights by one two-dimensional (0, 2)-net: a column by the sums of columns, then a row by its
// running sum. So aligned blocks of 2ᵏ lights are evenly distributed, too. Their mean over seeds is
// the light of all texels. A texel may be chosen several times.
ChosenLights chooseLights(const ReflectiveMap& map, std::span<const float> importance,
                          const LightChoiceOptions& options);

// Merges samples at the same texel into one, in the order of the first choices. Not for samples
// between texels.
std::vector<SceneVpl> mergedLights(const ChosenLights& chosen);

// Sets the distance at which the 1/d² term of each light is bounded: at least `clampDistance` [m],
// and such that no light gives a point more irradiance than `mostIrradiance` [W/m²]. A sample with
// a small probability is very bright and would otherwise be visible as a blotch on near surfaces.
std::vector<MapLight> boundedLights(std::span<const SceneVpl> lights, float clampDistance,
                                    float mostIrradiance);

}  // namespace lamplighter
