// The light samples of a frame, by the slots of their shadow maps. All stages of the frame read the
// same table.
#pragma once

#include <vector>

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// A light sample that is shown, or that waits to be shown.
struct LightSample : SceneVpl {
  bool isLive = false;      // shown; otherwise `vpl` is its future state
  bool isUpToDate = false;  // shown as it is wanted, and its map shows the present scene
  bool isStale = false;     // it waits for an update
  bool hasMap = false;      // of the light as it is shown
  int framesWaiting = 0;    // since it waits
};

struct LightSampleTable {
  // By slot. A slot without a light has the zero normal (isLight()).
  std::vector<LightSample> samples;
  // By slot: the lights to sum. While samples of a light are missing, the others carry its flux, so
  // intensities may be higher than those of the samples. Zero normal: nothing to sum.
  std::vector<shared::Vpl> summed;
  // The slots with a light, in an order that does not depend on history: that of the wanted ones.
  std::vector<int> order;

  size_t slots() const { return samples.size(); }
  const LightSample& operator[](int slot) const { return samples[static_cast<size_t>(slot)]; }
  // By slot, whether the predicate is true for the sample.
  template <typename Is>
  std::vector<bool> where(const Is& is) const {
    std::vector<bool> found(slots(), false);
    for (const int slot : order) found[static_cast<size_t>(slot)] = is((*this)[slot]);
    return found;
  }
  std::vector<LightSample> samplesInOrder() const;
  std::vector<shared::Vpl> summedInOrder() const;
  // Sums only the samples for which the predicate is true.
  template <typename Is>
  void sumOnly(const Is& is) {
    for (const int slot : order)
      if (!is((*this)[slot])) summed[static_cast<size_t>(slot)] = {};
  }
};

}  // namespace lamplighter
