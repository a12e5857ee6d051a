// Parameters of many_lights only; common_parameters.h has those shared with other methods.
#pragma once

#include "renderer/base/parameters.h"

namespace lamplighter::parameters {

const ParameterSpec& technique();        // the acceleration techniques of the paper that are used
const ParameterSpec& sunMaps();          // int, shadow maps per sun
const ParameterSpec& importance();       // int, candidates per indirect VPL; 1: all are used
const ParameterSpec& settledMapScale();  // int, resolution of fine maps / resolution of coarse maps
// int, limit of each kind of work per frame; 0: no limit
const ParameterSpec& maxShadowMaps();
const ParameterSpec& maxVisibilityTests();
const ParameterSpec& maxLightMapTexels();
const ParameterSpec& maxRays();
const ParameterSpec& maxPaths();          // int, paths traced again; 0: no limit
const ParameterSpec& groupShare();        // float, percent; 0: no groups
const ParameterSpec& mapMemory();         // int, MiB
const ParameterSpec& visibilityMemory();  // int, MiB
const ParameterSpec& lightMapMemory();    // int, MiB
const ParameterSpec& prtMemory();         // int, MiB
const ParameterSpec& frameTime();         // float, ms; used only in the editor's window
const ParameterSpec& lightMapTexel();     // float, m
const ParameterSpec& lightsPerPass();     // int, VPLs per draw of the gl backend
const ParameterSpec& mergePasses();       // bool, gl backend: merge passes
const ParameterSpec& block();        // choice, pixels per side of the low-resolution pass's blocks
const ParameterSpec& prt();          // bool, cpu backend: transfer for complex meshes
const ParameterSpec& prtPoints();    // int, light points per object
const ParameterSpec& prtBounces();   // int, interreflections within a mesh
const ParameterSpec& prtError();     // float, largest relative error of light by transfer
const ParameterSpec& antialias();    // int, G-buffers averaged when the lights are settled
const ParameterSpec& cornerLight();  // bool
// int, total number of VPLs; used only if the caller allows refinement
const ParameterSpec& refine();

}  // namespace lamplighter::parameters
