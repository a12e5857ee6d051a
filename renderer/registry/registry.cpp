#include "renderer/registry/registry.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/path_tracer/reference_method.h"

namespace lamplighter {

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all{manyLightsInfo(), referenceInfo()};
  return all;
}

const MethodInfo& findMethod(const std::string& name) {
  const auto& all = methods();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) { return m.name == name; });
  if (it != all.end()) return *it;
  std::string names;
  for (const MethodInfo& m : all) names += (names.empty() ? "" : ", ") + m.name;
  throw InputError("method", "there is no '" + name + "'", "give one of: " + names);
}

}  // namespace lamplighter
