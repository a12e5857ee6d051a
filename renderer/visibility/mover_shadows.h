// Which lights have what moved between them and a patch: eight at a time, and where it was met
// before first, for that is most of what a drag asks.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/occluders.h"
#include "renderer/visibility/pyramid_batch.h"
#include "renderer/visibility/shadow_reaches.h"

namespace lamplighter {

class MoverShadows {
 public:
  static constexpr size_t kLights = PyramidBatch::kLights;  // that may be asked for at once
  // Where what moved was met, as a hint for the next time. It changes no answer.
  using Hint = uint8_t;
  static constexpr Hint kHints = 250, kNoHint = kHints;
  struct Question {
    size_t slot;
    Hint hint = kNoHint;
  };
  struct Answer {
    PyramidBatch::Mask met = 0;       // bit i: the light asked for with index i
    std::array<Hint, kLights> hints;  // of those that are met
    // While no box of the movers goes or grows by as much, the answer is the same [m]; 0: unknown.
    PyramidBatch::Depths slack;
  };

  // The movers as they are placed; lights by slot.
  MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
               std::span<const shared::Vpl> lights);

  // Not those that are parallel; none where a mover may hide whole patches, or is not of groups.
  bool isAbout(size_t slot) const { return isUseful_ && !lights_[slot].isParallel; }
  // Of lights wanted, those of which the shadow of a mover may fall on the sphere around a patch:
  // bit i is that of slot 64 * word + i.
  uint64_t mayFallOn(size_t word, uint64_t wanted, const vec3& centre, float radius) const {
    uint64_t mask = 0;
    for (const ShadowReaches& reaches : allReaches_)
      mask |= reaches.mayFallOn(word, wanted, centre, radius);
    return mask;
  }
  // Of lights it is about, those, for which the patch, a rectangle, is neither dark nor degenerate:
  // what Occluders::occlusionBy() says, partial where met, else none.
  Answer of(const PatchRegion& region, std::span<const Question> lights) const;

 private:
  struct Light {
    PyramidApex apex;
    bool isParallel = false;
  };
  struct Mover {
    Caster caster;
    BoxBatches groups;
    size_t firstHint = 0;  // of all movers' batches one after the other
  };
  // The batch of a mover that a hint is of; none of it: past all.
  size_t hinted(size_t mover, Hint hint) const {
    return hint >= movers_[mover].firstHint ? hint - movers_[mover].firstHint : kNoHint;
  }
  const ShadowReach& reachOf(size_t slot, size_t mover) const {
    return reaches_[slot * movers_.size() + mover];
  }

  std::vector<Mover> movers_;
  bool isUseful_;
  std::vector<Light> lights_;
  std::vector<ShadowReach> reaches_;       // by light and mover
  std::vector<ShadowReaches> allReaches_;  // by mover
  float rounding_ = 0.0f;                  // of places of movers [m]
};

}  // namespace lamplighter
