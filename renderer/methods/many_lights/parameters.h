// Parameters of many_lights alone; those shared with other methods are in common_parameters.h.
#pragma once

#include "renderer/base/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique();        // which of the paper's short cuts are taken
const ParameterSpec& sunMaps();          // int, shadow maps of each sun
const ParameterSpec& importance();       // int, candidates for each indirect VPL; 1: all are taken
const ParameterSpec& settledMapScale();  // int, texels a side of fine maps by those of coarse ones
// int, the most work of each kind in a frame; 0: no limit
const ParameterSpec& maxShadowMaps();
const ParameterSpec& maxVisibilityTests();
const ParameterSpec& maxLightMapTexels();
const ParameterSpec& maxRays();
const ParameterSpec& maxPaths();          // int, 0: no limit; walked again
const ParameterSpec& groupShare();        // float, percent; 0: no groups
const ParameterSpec& mapMemory();         // int, MiB
const ParameterSpec& visibilityMemory();  // int, MiB
const ParameterSpec& lightMapMemory();    // int, MiB
const ParameterSpec& prtMemory();         // int, MiB
const ParameterSpec& frameTime();         // float, ms; heeded in the editor's window alone
const ParameterSpec& lightMapTexel();     // float, m
const ParameterSpec& lightsPerPass();     // int, VPLs that one draw of the gl backend takes
const ParameterSpec& mergePasses();       // bool, gl backend: by merged passes
const ParameterSpec& block();        // choice, pixels a side of the low-resolution pass's blocks
const ParameterSpec& prt();          // bool, cpu backend: complex meshes by transfer
const ParameterSpec& prtPoints();    // int, light points an object
const ParameterSpec& prtBounces();   // int, of light within a mesh
const ParameterSpec& prtError();     // float, share of light that transfer may get wrong
const ParameterSpec& antialias();    // int, G-buffers averaged once the lights are settled
const ParameterSpec& cornerLight();  // bool
const ParameterSpec& refine();       // int, VPLs in all; heeded where the caller lets it

}  // namespace lamplighter::parameters
