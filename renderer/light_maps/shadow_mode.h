// How the pixels of a patch come by a light.
#pragma once

#include <cstdint>

namespace lamplighter {

enum class ShadowMode : uint8_t {
  skip,           // nothing to sum: it is hidden, or the light map has all of it
  add,            // nothing stands between
  addShadowed,    // with a look-up in its shadow map
  subtractShadow  // the light map has it without shadow: what its shadow map hides is taken away
};

constexpr bool readsShadowMap(ShadowMode use) {
  return use == ShadowMode::addShadowed || use == ShadowMode::subtractShadow;
}

}  // namespace lamplighter
