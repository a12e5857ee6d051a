#include "renderer/methods/inspection.h"

namespace lamplighter {

const char* nameOf(Capability capability) {
  static constexpr const char* kNames[] = {
      "light samples",        "patches", "texels", "surface elements",
      "precomputed transfer", "points",  "links"};
  return kNames[static_cast<size_t>(capability)];
}

bool Inspection::has(Capability capability) const {
  switch (capability) {
    case Capability::lights:
      return !lights.empty();
    case Capability::patches:
      return patches != nullptr;
    case Capability::texels:
      return texels != nullptr;
    case Capability::elements:
      return elements != nullptr;
    case Capability::transfer:
      return transfer != nullptr;
    case Capability::points:
      return points != nullptr;
    case Capability::links:
      return links != nullptr;
  }
  return false;
}

}  // namespace lamplighter
