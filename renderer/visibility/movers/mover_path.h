// How far what moves has gone, all steps of a drag together, in counts that fit a byte. An answer
// about it that is right by a distance stays so until that is gone, and is not asked for again.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/motion_metric.h"
#include "renderer/visibility/occlusion/shadow_volume.h"

namespace lamplighter {

// Where a mover is: the sphere and the boxes that it is taken for.
struct MoverPlace {
  Caster caster;
  std::vector<Bounds> groups;
};
// How far one of them went or grew, at most, as the way counts it [m]; infinite where they are not
// the same number.
float farthestStep(const MoverPlace& before, const MoverPlace& now, const MotionMetric& way);

class MoverPath {
 public:
  using Mark = uint8_t;  // 0: nothing is known

  // Other things move: marks of before are void.
  void restart() { *this = MoverPath(); }

  // One step more of all that moves. By how much all marks are to be lowered, down to 0.
  Mark advance(std::span<const MoverPlace> before, std::span<const MoverPlace> now);
  // The same where no box went or grew by more than this, as way() counts it [m]. `size`: that of
  // the least mover [m].
  Mark advance(float distance, float size);

  // As distances are counted. It changes only where advance() makes all marks void.
  const MotionMetric& way() const { return way_; }

  size_t steps() const { return steps_; }
  float lastStep() const { return lastStep_; }  // as way() counts it [m]

  // Until when an answer stands that holds while less than this is gone [m].
  Mark markAfter(float slack) const {
    const float till = at_ + slack / count_;
    return slack > 0.0f && count_ > 0.0f ? static_cast<Mark>(std::fmin(till, kLast)) : Mark{0};
  }
  // The least mark that still stands.
  Mark now() const { return static_cast<Mark>(std::ceil(at_)); }

 private:
  static constexpr float kFirst = 1.0f, kLast = 255.0f;
  static constexpr Mark kLowerBy = 128;

  bool turn(std::span<const MoverPlace> before, std::span<const MoverPlace> now);
  Mark makeVoid();

  float at_ = kFirst;   // in counts
  float count_ = 0.0f;  // [m]; 0: not known yet
  size_t steps_ = 0;
  float lastStep_ = 0.0f;
  MotionMetric way_;
  vec3 direction_{0.0f};  // of the step before
};

}  // namespace lamplighter
