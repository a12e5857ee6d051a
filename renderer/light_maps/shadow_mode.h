// How the pixels of a patch sum a light.
#pragma once

#include <cstdint>

namespace lamplighter {

enum class ShadowMode : uint8_t {
  skip,           // nothing to sum: the light is hidden, or the light map holds all of it
  add,            // without a shadow map look-up: nothing can block the light
  addShadowed,    // with a shadow map look-up
  subtractShadow  // the light map contains it unshadowed: subtract the part that is hidden in the
                  // shadow map
};

constexpr bool readsShadowMap(ShadowMode use) {
  return use == ShadowMode::addShadowed || use == ShadowMode::subtractShadow;
}

}  // namespace lamplighter
