// Which lights have what moved between them and a patch: eight at a time, and where it was met
// before first, for that is most of what a drag asks.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/visibility/movers/mover_path.h"
#include "renderer/visibility/movers/shadow_volumes.h"
#include "renderer/visibility/occlusion/occluders.h"
#include "renderer/visibility/occlusion/pyramid_batch.h"

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
    // While no box of the movers goes or grows by as much, as the way counts it, the answer is the
    // same [m]; 0: unknown.
    PyramidBatch::Depths slack;
  };

  // The movers as they are placed; lights by slot; the path that they go.
  MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
               std::span<const shared::Vpl> lights, const MoverPath& path);

  // Not those that are parallel; none where a mover may hide whole patches, or is not of groups.
  bool isAbout(size_t slot) const { return isUseful_ && !lights_[slot].isParallel; }
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
    size_t firstHint = 0;  // of all movers' hints one after the other
  };
  // Some in each step: most that are not met deep enough never are.
  bool looksFurther(size_t slot) const { return (slot + turn_) % kTurns == 0; }

  static constexpr size_t kTurns = 4;

  struct Asked;
  void ask(const Asked& asked, size_t mover, Answer& answer) const;
  PyramidBatch::Mask askWhereHinted(const Asked& asked, size_t mover, PyramidBatch::Mask open,
                                    PyramidBatch::Depths& depths, Answer& answer) const;
  Hint hintOf(size_t mover, int box) const;

  std::vector<Mover> movers_;
  bool isUseful_;
  MotionMetric way_;
  float enough_;  // what answers are to stand for, if that is easily had [m]
  size_t turn_;
  std::vector<Light> lights_;
  std::vector<ShadowVolume::Cone> cones_;  // of shadows, by light and mover
  size_t boxesAHint_ = 1;                  // as few as fit what a hint can say
  float rounding_ = 0.0f;                  // of places of movers [m]
};

}  // namespace lamplighter
