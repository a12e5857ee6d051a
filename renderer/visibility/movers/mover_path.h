// The distance that movers have gone over all steps of a drag, in counts that fit into a byte. A
// test result that stays valid up to some distance gets a mark; it is not tested again before the
// movers reach the mark.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/occlusion/motion_metric.h"
#include "renderer/visibility/occlusion/shadow_volume.h"

namespace lamplighter {

// Position of a mover: its bounding sphere and the boxes of its groups.
struct MoverPlace {
  Caster caster;
  std::vector<Bounds> groups;
};
// Largest distance that the bounding sphere or one of the boxes moved or grew, measured by
// `metric` [m]. Infinite if the numbers of boxes differ.
float farthestStep(const MoverPlace& before, const MoverPlace& now, const MotionMetric& metric);

class MoverPath {
 public:
  using Mark = uint8_t;  // 0: unknown

  // Other objects move now: invalidates all earlier marks.
  void restart() { *this = MoverPath(); }

  // Adds one step of all movers. Returns the amount by which all marks must be lowered, down to 0.
  Mark advance(std::span<const MoverPlace> before, std::span<const MoverPlace> now);
  // The same, given that no box moved or grew by more than `distance`, measured by metric()
  // [m]. `size`: radius of the smallest mover [m].
  Mark advance(float distance, float size);

  // The present metric. It changes only when advance() invalidates all marks.
  const MotionMetric& metric() const { return metric_; }

  size_t steps() const { return steps_; }
  float lastStep() const { return lastStep_; }  // measured by metric() [m]

  // The mark up to which a result is valid that holds while the distance is less than `slack` [m].
  Mark markAfter(float slack) const {
    const float till = at_ + slack / count_;
    return slack > 0.0f && count_ > 0.0f ? static_cast<Mark>(std::fmin(till, kLast)) : Mark{0};
  }
  // The smallest mark that is still valid.
  Mark now() const { return static_cast<Mark>(std::ceil(at_)); }

 private:
  static constexpr float kFirst = 1.0f, kLast = 255.0f;
  static constexpr Mark kLowerBy = 128;

  bool turn(std::span<const MoverPlace> before, std::span<const MoverPlace> now);
  Mark makeVoid();

  float at_ = kFirst;   // present position, in counts
  float count_ = 0.0f;  // metres per count; 0: not known yet
  size_t steps_ = 0;
  float lastStep_ = 0.0f;
  MotionMetric metric_;
  vec3 direction_{0.0f};  // of the previous step
};

}  // namespace lamplighter
