// What one side of a split view, or one tile, shows.
#pragma once

#include <string>
#include <vector>

#include "editor/document/document.h"

namespace lamplighter {

// "live" or the name of a method; either may have its own parameters: "many_lights,vpls=1000".
struct SplitSide {
  std::string text = "live";
  std::string method;  // "": the document's method
  Settings values;     // override the document's values
  bool isLive() const { return method.empty() && values.values().empty(); }
  RenderSettings of(const RenderSettings& document) const;
};
// Throws InputError for an unknown method or parameter. `method`: the document's.
SplitSide readSide(const std::string& text, const std::string& method);

// The names of all methods that show light, the reference last.
std::vector<std::string> methodsOfLight();

}  // namespace lamplighter
