// Internal data of a method for debug views: pointers to what it keeps between frames.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

class LightMaps;
class PrtLights;
class VisibilityDatabase;

// A light sample that is shown, or that waits to be shown.
struct InspectedLight {
  shared::Vpl vpl{};
  VplId id;
  int slot = -1;          // of its shadow map; also its column in the database
  bool isLive = false;    // shown; otherwise `vpl` is its future state
  bool isStale = false;   // it waits for an update
  int framesWaiting = 0;  // since it waits
  bool isSample = true;   // SceneVpl::isSample
};

// Valid until the method's next render() or reset(). Data that a method does not have are null or
// empty.
struct Inspection {
  const VisibilityDatabase* visibility = nullptr;
  const LightMaps* lightMaps = nullptr;
  std::vector<InspectedLight> lights;  // in an order that does not change with edits
  const PrtLights* prt = nullptr;
};

}  // namespace lamplighter
