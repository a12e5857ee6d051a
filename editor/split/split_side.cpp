#include "editor/split/split_side.h"

#include <algorithm>
#include <sstream>

#include "renderer/base/error.h"
#include "renderer/methods/path_tracer/reference_method.h"
#include "renderer/registry/registry.h"

namespace lamplighter {

RenderSettings SplitSide::of(const RenderSettings& document) const {
  RenderSettings settings = document;
  if (!method.empty()) settings.method = method;
  for (const auto& [name, value] : values.values()) settings.values.set(name, value);
  return settings;
}

SplitSide readSide(const std::string& text, const std::string& method) {
  SplitSide side;
  side.text = text;
  std::istringstream in(text);
  std::string part;
  std::getline(in, part, ',');
  if (part != "live") side.method = findMethod(part).name;
  const auto& all = findMethod(side.method.empty() ? method : side.method).parameters;
  while (std::getline(in, part, ',')) {
    const size_t equals = part.find('=');
    const ParameterSpec* spec = findParameter(all, part.substr(0, equals));
    if (equals == std::string::npos || !spec)
      throw InputError(text, "'" + part + "' does not set a parameter of the method",
                       "give live or a method, then ,NAME=VALUE for each parameter");
    side.values.set(spec->name, Settings::parse(*spec, part.substr(equals + 1)));
  }
  return side;
}

std::vector<std::string> methodsOfLight() {
  std::vector<std::string> names;
  for (const MethodInfo& m : methods())
    if (findParameter(m.parameters, "bounces") != nullptr) names.push_back(m.name);
  std::ranges::stable_partition(names, [](const std::string& n) { return n != kReferenceMethod; });
  return names;
}

}  // namespace lamplighter
