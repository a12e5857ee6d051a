// What the pixels of a patch do with a light.
#pragma once

#include <cstdint>

namespace lamplighter {

enum class ShadowMode : uint8_t {
  skip,           // nothing to sum: the light is hidden, or the light map holds all of it
  add,            // no occluder can be between
  addShadowed,    // with a shadow map look-up
  subtractShadow  // the light map holds it unshadowed: subtract what the shadow map says is hidden
};

constexpr bool readsShadowMap(ShadowMode use) {
  return use == ShadowMode::addShadowed || use == ShadowMode::subtractShadow;
}

}  // namespace lamplighter
