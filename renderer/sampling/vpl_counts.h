// Distributes the number of samples over lights.
#pragma once

#include <span>
#include <vector>

namespace lamplighter {

struct SampleShare {
  float weight = 0.0f;   // flux; 0: gets no samples
  int least = 1;         // minimum number of samples
  bool isFixed = false;  // gets no more than the minimum
};

struct SampleCounts {
  std::vector<int> counts;  // one for each share
  // Total flux divided by the flux of shares with samples: 1 unless `total` was too small.
  float scale = 1.0f;
};

// Gives each share its minimum and distributes the rest by weight (largest remainder first, ties in
// order). If `total` is too small, the shares with the largest weights are served (at least one),
// and `scale` compensates for the others.
SampleCounts shareSamples(std::span<const SampleShare> shares, int total);

}  // namespace lamplighter
