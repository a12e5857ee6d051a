// Parameters that methods share, declared once.
#pragma once

#include "renderer/base/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& bounces();          // int, indirect bounces, 0: direct only; default 2
const ParameterSpec& seed();             // int
const ParameterSpec& vpls();             // int, light samples in all; default 300
const ParameterSpec& directShare();      // float in [0, 1]; default 0.5
const ParameterSpec& mapResolution();    // int, texels a side, default 64
const ParameterSpec& updates();          // int, VPLs replaced a frame at most; default 100
const ParameterSpec& clampDistance();    // float, metres; the bounded G-term's d0
const ParameterSpec& shadowBias();       // float, share of the distance
const ParameterSpec& samplesPerPixel();  // int; reference: paths a pixel
const ParameterSpec& samplesPerFrame();  // int; reference: paths a pixel a frame

const ParameterSpec& speculars();       // bool, metallic-roughness at the surface that is seen
const ParameterSpec& leastRoughness();  // float in [0.05, 1]

}  // namespace lamplighter::parameters
