#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique() {
  static const ParameterSpec spec{
      "technique",
      "Technique",
      "",
      "naive: every light sample with its shadow map at every pixel. visibility: maps are looked "
      "up only where the geometry cannot tell whether something stands between.",
      std::string("naive"),
      0,
      0,
      false,
      {"naive", "visibility"}};
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
