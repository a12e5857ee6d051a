// How many samples each light gets.
#pragma once

#include <span>
#include <vector>

namespace lamplighter {

struct SampleShare {
  float weight = 0.0f;   // flux; 0: gets none
  int least = 1;         // samples it cannot do without
  bool isFixed = false;  // and needs no more than those
};

struct SampleCounts {
  std::vector<int> counts;  // one for each share
  // Flux of all over flux of those that got samples: 1 unless there were too few samples.
  float scale = 1.0f;
};

// Gives each the least it needs and the rest by weight, largest remainder first, ties in order.
// When `total` is too small for that, the heaviest are served (one at least) and scale makes up for
// the others.
SampleCounts shareSamples(std::span<const SampleShare> shares, int total);

}  // namespace lamplighter
