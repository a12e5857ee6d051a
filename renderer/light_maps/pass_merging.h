// Fewer draws for objects that share lights (paper 1, 4.3.5, figure 4-10).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// Objects that are drawn together, and the lights that each of them needs. Both ascending.
struct PassElement {
  std::vector<uint32_t> objects;
  std::vector<uint32_t> lights;
  bool operator==(const PassElement&) const = default;
};

// Draws that an element needs when each takes `lightsPerPass` lights at most.
int passesOf(const PassElement& element, int lightsPerPass);

struct MergedPasses {
  std::vector<PassElement> elements;  // none without lights
  int passes = 0;                     // that they need
  int saved = 0;                      // of those that were needed before
};

// Takes the pair of elements that saves most passes, while there is one (of equals, the first): its
// lights in common go to a new element with the objects of both. Each object keeps each of its
// lights, once. Quadratic in the number of elements and worse, as the paper's is.
MergedPasses mergePasses(std::span<const PassElement> elements, int lightsPerPass);

// An element for each object: the lights, by slot, that need their shadow maps somewhere on it.
// Objects in `seen` only.
std::vector<PassElement> shadowedLights(const VisibilityDatabase& visibility,
                                        std::span<const uint32_t> seen);

}  // namespace lamplighter
