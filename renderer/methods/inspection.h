// What a method lets views of its insides see: pointers into what it keeps between frames.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

class LightMaps;
class PrtLights;
class VisibilityDatabase;

// A light sample as it is shown, or waits to be.
struct InspectedLight {
  shared::Vpl vpl{};
  VplId id;
  int slot = -1;          // of its shadow map, and its column in the database
  bool isLive = false;    // it is shown; else `vpl` is what it will be
  bool isStale = false;   // it waits to be brought up to date
  int framesWaiting = 0;  // for so long
  bool isSample = true;   // SceneVpl::isSample
};

// Good until the method's next render() or reset(). What a method does not have is null or empty.
struct Inspection {
  const VisibilityDatabase* visibility = nullptr;
  const LightMaps* lightMaps = nullptr;
  std::vector<InspectedLight> lights;  // in an order that edits leave alone
  const PrtLights* prt = nullptr;
};

}  // namespace lamplighter
