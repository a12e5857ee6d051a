// Internal data of a method for debug views: pointers to what it keeps between frames.
#pragma once

#include <vector>

#include "renderer/sampling/light_sample_table.h"

namespace lamplighter {

class LightMaps;
class PrtLights;
class VisibilityDatabase;

// Valid until the method's next render() or reset(). Data that a method does not have are null or
// empty.
struct Inspection {
  const VisibilityDatabase* visibility = nullptr;
  const LightMaps* lightMaps = nullptr;
  std::vector<LightSample> lights;  // in an order that does not change with edits
  const PrtLights* prt = nullptr;
};

}  // namespace lamplighter
