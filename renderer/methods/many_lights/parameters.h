// Parameters of many_lights alone; those shared with other methods are in common_parameters.h.
#pragma once

#include "renderer/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique();      // which of the paper's short cuts are taken
const ParameterSpec& lightMapTexel();  // float, m
const ParameterSpec& antialias();      // int, G-buffers averaged once the lights are settled

}  // namespace lamplighter::parameters
