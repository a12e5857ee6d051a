// Fewer draws for objects that share lights (paper 1, 4.3.5, figure 4-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// Objects that are drawn together and the lights that all of them need. Both lists are ascending.
struct PassElement {
  std::vector<uint32_t> objects;
  std::vector<uint32_t> lights;
  bool operator==(const PassElement&) const = default;
};

// The number of draws for an element if each draw takes at most `lightsPerPass` lights.
int passesOf(const PassElement& element, int lightsPerPass);

struct MergedPasses {
  std::vector<PassElement> elements;  // without elements that have no lights
  int passes = 0;                     // that the elements need
  int saved = 0;                      // passes fewer than before merging
};

// Repeatedly takes the pair of elements that saves the most passes (the first of equals) and moves
// their common lights to a new element with the objects of both, until no pair saves any. Each
// object keeps each of its lights exactly once. At least quadratic in the number of elements, as in
// the paper.
MergedPasses mergePasses(std::span<const PassElement> elements, int lightsPerPass);

// One element per object in `seen`: the slots of the lights that need a shadow map look-up on some
// part of it.
std::vector<PassElement> shadowedLights(const VisibilityDatabase& visibility,
                                        std::span<const uint32_t> seen);

}  // namespace lamplighter
