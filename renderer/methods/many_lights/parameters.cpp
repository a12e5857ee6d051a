#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique() {
  static const ParameterSpec spec{
      "technique",
      "Technique",
      "",
      "naive: every light sample with its shadow map at every pixel. visibility: maps are looked "
      "up only where the geometry cannot tell whether something stands between. light_maps: "
      "besides, light without shadows is summed once for flat surfaces, and pixels only take "
      "shadows away.",
      std::string("naive"),
      0,
      0,
      false,
      {"naive", "visibility", "light_maps"}};
  return spec;
}

const ParameterSpec& lightMapTexel() {
  static const ParameterSpec spec{
      "light_map_texel",
      "Light map texel",
      "m",
      "Spacing of the light maps' texels; patches that would need more than 33 a side get 33.",
      0.1f,
      0.01,
      2.0,
      true,
      {}};
  return spec;
}

const ParameterSpec& antialias() {
  static const ParameterSpec spec{
      "antialias",
      "Samples a pixel",
      "",
      "Pictures with shifted pixels that are averaged, one a frame, once the lights are settled.",
      4,
      1,
      256,
      true,
      {}};
  return spec;
}

}  // namespace lamplighter::parameters
