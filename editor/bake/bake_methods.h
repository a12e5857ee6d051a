// The methods that light maps, vertex colours and probes can be baked with, and the conversion of
// their parameters to options of baking.
#pragma once

#include <string>
#include <vector>

#include "renderer/bake/baked_light.h"
#include "renderer/base/parameters.h"

namespace lamplighter {

struct BakeMethodInfo {
  std::string name;     // of the method, as for --method
  std::string summary;  // how it finds light, a clause
  BakeLightOptions (*options)(Settings settings);
};

const std::vector<BakeMethodInfo>& bakeMethods();
// `method`: a name of bakeMethods(). Parameters that are not set have defaults for baking where
// these differ from those of the viewport.
BakeLightOptions bakeLightOptions(const std::string& method, const Settings& settings);

}  // namespace lamplighter
