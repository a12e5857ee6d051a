// Statistics of the method of paper 2.
#pragma once

#include "renderer/methods/common_statistics.h"
#include "renderer/methods/imperfect_light/imperfect_picture.h"

namespace lamplighter {

struct ImperfectStats : GiStats {
  int lightSamples = 0;  // on the lights
  int bouncedSamples = 0, potentialLights = 0;
  int pathsWalked = 0;     // in this frame
  float defended = 0.0f;   // share of the flux
  int occluderPoints = 0;  // of the pool
  int pointsPending = 0;   // frames
  uint64_t pointBytes = 0;

  void take(const ImperfectPicture& picture);
};
const StatisticTable<ImperfectStats>& imperfectStatistics();

}  // namespace lamplighter
