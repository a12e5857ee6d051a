#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique() {
  static const ParameterSpec spec{"technique",
                                  "Technique",
                                  "",
                                  "naive: every light sample with its shadow map at every pixel.",
                                  std::string("naive"),
                                  0,
                                  0,
                                  false,
                                  {"naive"}};
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
