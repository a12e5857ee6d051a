// Distributes the number of samples over lights.
#pragma once

#include <span>
#include <vector>

namespace lamplighter {

struct SampleShare {
  float weight = 0.0f;   // flux; 0: gets no samples
  int least = 1;         // minimum number of samples
  bool isFixed = false;  // gets no more than the minimum
  float order = 0.0f;    // if there are too few samples, shares with more of it are served first
};

// Contribution of an emitter to the view (choice/lamp_importance.h).
struct LampShare {
  // Root mean square of its share of the light at points of the view, [0, 1].
  float importance = 0.0f;
  float light = 0.0f;      // mean of its share of the light there, [0, 1]
  bool isLeftOut = false;  // gets no samples
  bool operator==(const LampShare&) const = default;
};

// The nearest power of two, by ratio, of a positive value.
float nearestPowerOfTwo(float v);

struct SampleCounts {
  std::vector<int> counts;  // one for each share
  // Total flux divided by the flux of shares with samples: 1 unless `total` was too small.
  float scale = 1.0f;
};

// Gives each share its minimum and distributes the rest by weight (largest remainder first, ties in
// order). If `total` is too small, those with the largest order, then weight, are served (at least
// one),
// and `scale` compensates for the others.
SampleCounts shareSamples(std::span<const SampleShare> shares, int total);

}  // namespace lamplighter
