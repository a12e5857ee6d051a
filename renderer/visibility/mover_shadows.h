// Which lights have what moved between them and a patch: eight at a time, and where it was met
// before first, for that is most of what a drag asks.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/occluders.h"
#include "renderer/visibility/pyramid_batch.h"

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
  };

  // The movers as they are placed; lights by slot.
  MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
               std::span<const shared::Vpl> lights);

  // Not those that are parallel; none where a mover may hide whole patches, or is not of groups.
  bool isAbout(size_t slot) const { return isUseful_ && !lights_[slot].isParallel; }
  // Of lights it is about for which the patch, a rectangle, is neither dark nor degenerate: what
  // Occluders::occlusionBy() says, partial where met, else none.
  Answer of(const PatchRegion& region, std::span<const Question> lights) const;

 private:
  struct Light {
    PyramidApex apex;
    bool isParallel = false;
  };
  struct Mover {
    Caster caster;
    Bounds box;                         // around its groups
    size_t groups = 0, firstGroup = 0;  // of all movers' one after the other
    std::vector<BoxBatch> batches;      // of groups, neighbours together
    std::vector<BoxBatch> around;       // a box around each of these
  };
  // Group's boxes that hints are of: all, or as many as there are hints.
  struct Hinted {
    Bounds box;
    size_t mover = 0;
  };
  Hint hintOf(size_t mover, size_t group) const {
    return static_cast<Hint>((movers_[mover].firstGroup + group) * hinted_.size() / groups_);
  }
  // The first of its groups that is met, or kNone.
  int firstMet(const Mover& mover, const PyramidBatch& pyramids, size_t light) const;
  bool reaches(size_t slot, size_t mover, const PatchRegion& region) const {
    return reaches_[slot * movers_.size() + mover].mayFallOn(region.centre, region.radius);
  }

  std::vector<Mover> movers_;
  bool isUseful_;
  std::vector<Light> lights_;
  std::vector<ShadowReach> reaches_;  // by light and mover
  std::vector<Hinted> hinted_;
  size_t groups_ = 0;
};

}  // namespace lamplighter
