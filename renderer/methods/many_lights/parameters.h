// The parameters of many_lights. options.h has the form that its stages use.
#pragma once

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/field_light/parameters.h"
#include "renderer/methods/stored_depth_parameters.h"
#include "renderer/methods/surface_light_parameters.h"

namespace lamplighter {

// The acceleration techniques of the paper; each includes the previous ones.
enum class ManyLightsTechnique { naive, visibility, lightMaps };

// The carrier of bounced light: light samples, or light stored on surfaces. automatic: by a rule on
// the scene (carrier_rule.h) on the cpu backend; samples on the gl backend, where the other
// carriers need to read the picture back.
enum class ManyLightsIndirect { automatic, samples, meshes, links, imperfect, field };

// Parameters that change how light samples are summed. Memory is in MiB.
struct LightSumParameters : SurfaceParameters {
  ManyLightsTechnique technique = ManyLightsTechnique::lightMaps;
  float clampDistance = 0.5f;  // d0 of the bounded geometry term [m]
  float shadowBias = 0.002f;   // share of the distance
  float groupShare = 0.2f;     // percent; 0: no groups
  int visibilityMemory = 1024, lightMapMemory = 1024, prtMemory = 1024;
  float lightMapTexel = 0.1f;  // [m]
  bool mergePasses = false;    // gl backend
  int block = 4;               // side of the blocks of the low-resolution pass [pixels]
  bool prt = false;            // transfer for complex meshes
  int prtPoints = 128;         // light points per object
  int prtBounces = 0;          // within a mesh
  float prtError = 0.15f;      // largest relative error of light by transfer
  bool operator==(const LightSumParameters&) const = default;
};

struct ManyLightsParameters : LightSumParameters,
                              PathParameters,
                              FrameBudgetParameters,
                              SurfaceLightParameters,
                              StoredDepthParameters,
                              LightFieldParameters {
  ManyLightsIndirect indirect = ManyLightsIndirect::automatic;
  int vpls = 300;  // direct and indirect ones
  float directShare = 0.5f;
  int importance = 8;  // candidates per indirect VPL; 1: all are used
  int mapResolution = 64;
  int settledMapScale = 6;  // resolution of fine maps / resolution of coarse maps
  int sunMaps = 128;        // per sun
  // Limits of each kind of work per frame; 0: no limit.
  int maxShadowMaps = 0, maxVisibilityTests = 0, maxLightMapTexels = 0, maxRays = 0, maxPaths = 0;
  int mapMemory = 512;       // MiB
  int lightsPerPass = 1024;  // VPLs per draw of the gl backend; does not change a picture
  int antialias = 4;         // G-buffers averaged when the lights are settled
  bool biasCompensation = true;
  int shareMemory = 512;  // MiB
  int refine = 65536;     // total number of VPLs; used only if the caller allows refinement
  bool operator==(const ManyLightsParameters&) const = default;
};

const ParameterTable<ManyLightsParameters>& manyLightsParameters();
// The parameters for methods whose light samples are all placed on the lights.
const ParameterTable<ManyLightsParameters>& directSampleParameters();

}  // namespace lamplighter
