// Tests for which lights a mover is between the light and a patch, eight lights at a time. It first
// tests where the mover was found last time; these tests are most of the cost of a drag.
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
  static constexpr size_t kLights = PyramidBatch::kLights;  // maximum per call of of()
  // Where the mover was met, as a hint for the next test. Hints do not change results.
  using Hint = uint8_t;
  static constexpr Hint kHints = 250, kNoHint = kHints;
  struct Question {
    size_t slot;
    Hint hint = kNoHint;
  };
  struct Answer {
    LightMask met = 0;                // bit i: the light of question i
    std::array<Hint, kLights> hints;  // for the lights that are met
    // The result stays valid while no box of the movers moves or grows by this much, in the metric
    // of the path [m]; 0: unknown.
    PyramidBatch::Depths slack;
  };

  // `occluders` holds the movers at their present positions; `lights` by slot; `path` of the
  // movers.
  MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
               std::span<const shared::Vpl> lights, const MoverPath& path);

  // Whether of() can test for this light. Not for parallel lights; for none if a mover may hide
  // whole patches or does not consist of groups only.
  bool isAbout(size_t slot) const { return isUseful_ && !lights_[slot].isParallel; }
  // For lights that isAbout() accepts and for which the patch, a rectangle, is neither dark nor
  // degenerate. Same results as Occluders::occlusionBy(): partial if met, otherwise none.
  Answer of(const PatchRegion& region, std::span<const Question> lights) const;

 private:
  struct Mover {
    Caster caster;
    BoxBatches groups;
    size_t firstHint = 0;  // the hints of all movers are numbered consecutively
  };
  // Whether to search for a box with more depth in this step. Only some lights do in each step,
  // because most lights without a box of enough depth never find one.
  bool looksFurther(size_t slot) const { return (slot + turn_) % kTurns == 0; }

  static constexpr size_t kTurns = 4;

  struct Asked;
  void ask(const Asked& asked, size_t mover, Answer& answer) const;
  LightMask askWhereHinted(const Asked& asked, size_t mover, LightMask open,
                           PyramidBatch::Depths& depths, Answer& answer) const;
  Hint hintOf(size_t mover, int box) const;

  std::vector<Mover> movers_;
  bool isUseful_;
  MotionMetric metric_;
  float enough_;  // desired slack of results, if it is cheap to reach [m]
  size_t turn_;
  std::vector<PyramidApex> lights_;
  std::vector<ShadowVolume::Cone> cones_;  // of shadow volumes, by light and mover
  size_t boxesAHint_ = 1;                  // as few as the range of a hint allows
  float rounding_ = 0.0f;                  // rounding error of the movers' positions [m]
};

}  // namespace lamplighter
