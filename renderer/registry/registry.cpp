#include "renderer/registry/registry.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/base/error.h"
#include "renderer/methods/ambient_occlusion/ambient_occlusion.h"
#include "renderer/methods/imperfect_shadow_maps/imperfect_shadow_maps.h"
#include "renderer/methods/light_field/light_field_method.h"
#include "renderer/methods/many_lights/many_lights.h"
#include "renderer/methods/multi_mesh/multi_mesh.h"
#include "renderer/methods/path_tracer/reference_method.h"
#include "renderer/methods/surface_shadow_maps/surface_shadow_maps.h"
#include "renderer/path_repair/repaired_method.h"

namespace lamplighter {
namespace {

std::deque<MethodInfo>& list() {
  static std::deque<MethodInfo> all{repaired(manyLightsInfo()),
                                    repaired(multiMeshInfo()),
                                    repaired(surfaceShadowMapsInfo()),
                                    repaired(imperfectShadowMapsInfo()),
                                    repaired(lightFieldInfo()),
                                    ambientOcclusionInfo(),
                                    referenceInfo()};
  return all;
}

}  // namespace

const std::deque<MethodInfo>& methods() { return list(); }

const MethodInfo& findMethod(const std::string& name) {
  const auto& all = methods();
  const auto it = std::ranges::find(all, name, &MethodInfo::name);
  if (it != all.end()) return *it;
  std::string names;
  for (const MethodInfo& m : all) names += (names.empty() ? "" : ", ") + m.name;
  throw InputError("method", "there is no method '" + name + "'", "give one of: " + names);
}

std::string methodsThatShow(Capability capability) {
  std::string who;
  for (const MethodInfo& method : methods())
    for (const ShownCapability& shown : method.shows)
      if (shown.capability == capability)
        who += (who.empty() ? "" : ", or ") + method.name + (shown.when.empty() ? "" : " ") +
               shown.when;
  return who;
}

void addMethod(MethodInfo method) {
  if (std::ranges::find(methods(), method.name, &MethodInfo::name) != methods().end())
    throw std::logic_error("there are two methods " + method.name);
  list().push_back(std::move(method));
}

std::string problemOf(const MethodInfo& method, const Backend& backend) {
  const std::string& on = backend.info().name;
  if (method.needs.openGl && on != "gl")
    return method.name + " needs OpenGL, so it does not run on the backend " + on;
  for (const KernelNeed& kernels : method.needs.kernels)
    if (!kernels.isMetBy(backend))
      return method.name + " needs the kernels " + kernels.name + ", which the backend " + on +
             " does not have";
  return "";
}

const MethodInfo& runnableMethod(const std::string& name, const Backend& backend) {
  const MethodInfo& method = findMethod(name);
  const std::string problem = problemOf(method, backend);
  if (problem.empty()) return method;
  throw InputError("method", problem, "choose another method or another --backend");
}

}  // namespace lamplighter
