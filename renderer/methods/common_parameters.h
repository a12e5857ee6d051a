// Parameters that methods share, declared once.
#pragma once

#include "renderer/base/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& bounces();  // int, number of indirect bounces, 0: direct light only; default 2
const ParameterSpec& seed();     // int
const ParameterSpec& vpls();     // int, total number of light samples; default 300
const ParameterSpec& directShare();      // float in [0, 1]; default 0.5
const ParameterSpec& mapResolution();    // int, texels per side, default 64
const ParameterSpec& updates();          // int, most VPLs replaced per frame; default 100
const ParameterSpec& clampDistance();    // float, metres; the bounded G-term's d0
const ParameterSpec& shadowBias();       // float, share of the distance
const ParameterSpec& samplesPerPixel();  // int; reference: paths per pixel
const ParameterSpec& samplesPerFrame();  // int; reference: paths per pixel and frame

const ParameterSpec& speculars();       // bool, metallic-roughness BRDF at visible surfaces
const ParameterSpec& leastRoughness();  // float in [0.05, 1]

}  // namespace lamplighter::parameters
