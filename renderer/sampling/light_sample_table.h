// The light samples of a frame: rows in a fixed order, and columns by the slots of their shadow
// maps. All stages of the frame, and Inspection, read the same table.
#pragma once

#include <span>
#include <vector>

#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// A light sample that is shown, or that waits to be shown. Its slot is vpl.slot.
struct LightSample : SceneVpl {
  bool isLive = false;      // shown; otherwise `vpl` is its future state
  bool isUpToDate = false;  // shown in its wanted state, and its map shows the current scene
  bool isStale = false;     // it waits for an update
  int framesWaiting = 0;    // number of frames for which it has waited
};

// The samples that are shown.
std::vector<SceneVpl> liveSamples(std::span<const LightSample> samples);

struct LightSampleTable {
  // All samples, in the order of the wanted ones, which does not depend on history.
  std::vector<LightSample> samples;

  // By slot: the lights to sum. While samples of a light are missing, the others carry its flux, so
  // intensities may be higher than those of the samples. Zero normal: nothing to sum.
  std::vector<shared::Vpl> summed;
  std::vector<vec3> reference;    // by slot: its intensity at the reference brightness of its light
  std::vector<uint8_t> needsMap;  // by slot: the view reads its shadow map
  std::vector<uint8_t> hasMap;    // by slot: it has a shadow map of the light in its shown state

  size_t slots() const { return summed.size(); }
  // By slot, whether the predicate is true for the sample.
  template <typename Is>
  std::vector<bool> where(const Is& is) const {
    std::vector<bool> found(slots(), false);
    for (const LightSample& sample : samples)
      found[static_cast<size_t>(sample.vpl.slot)] = is(sample);
    return found;
  }
  std::vector<shared::Vpl> summedInOrder() const;
  // Sums the samples at the reference brightness of their lights (reference_brightness.h), times
  // `factor` of each sample.
  template <typename Factor>
  void sumAtReference(const Factor& factor) {
    for (const LightSample& sample : samples) {
      const auto slot = static_cast<size_t>(sample.vpl.slot);
      summed[slot].intensity = factor(sample) * reference[slot];
    }
  }
  // Sums only the samples for which the predicate is true.
  template <typename Is>
  void sumOnly(const Is& is) {
    for (const LightSample& sample : samples)
      if (!is(sample)) summed[static_cast<size_t>(sample.vpl.slot)] = {};
  }
};

}  // namespace lamplighter
