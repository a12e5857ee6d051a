// The parameters of the method of paper 2.
#pragma once

#include "renderer/imperfect_maps/interleaved_light.h"
#include "renderer/methods/common_parameters.h"

namespace lamplighter {

// View samples that estimate the importance of potential lights.
enum class ViewChoice : uint8_t {
  fixed,   // the same points for all, found by rays
  random,  // pixels of a jittered grid, different for each potential light
  guided   // pixels near its image
};
// The view for which lights and points are chosen.
enum class ViewAdaption : uint8_t {
  off,     // lights by their flux, points by area
  steady,  // a view on a grid of places and directions
  eachFrame
};
enum class ImperfectRest : uint8_t { imperfect, maps };

struct ImperfectParameters : PathParameters, FrameBudgetParameters, SurfaceParameters {
  bool asPublished = false;
  int bouncedSamples = 1024;
  int potentialLights = 24576;
  ViewChoice viewChoice = ViewChoice::fixed;
  int viewSamples = 128;
  float defence = 10.0f;  // percent
  bool betweenTexels = false;
  ViewAdaption adapt = ViewAdaption::steady;
  int occluderPoints = 4096;  // of a map
  bool twoSided = true;
  int resolution = 64;
  SplatShape splats = SplatShape::tilted;
  HoleFilling fill = HoleFilling::planes;
  int interleave = 8;
  float clampDistance = 0.5f;  // [m]
  bool biasCompensation = true;
  ImperfectRest settle = ImperfectRest::maps;
  int settledResolution = 128;
  bool raysChoose = true;
  bool operator==(const ImperfectParameters&) const = default;

  // These parameters, with the values of the paper if asPublished.
  ImperfectParameters chosen() const;
  InterleavedOptions interleaved() const { return {{resolution, splats, fill}, interleave}; }
};

const ParameterTable<ImperfectParameters>& imperfectParameters();

}  // namespace lamplighter
