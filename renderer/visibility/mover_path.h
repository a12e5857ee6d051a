// How far what moves has gone, all steps of a drag together, in counts that fit a byte. An answer
// about it that is right by a distance stays so until that is gone, and is not asked for again.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/visibility/shadow_reach.h"

namespace lamplighter {

// Where a mover is: the sphere and the boxes that it is taken for.
struct MoverPlace {
  Caster caster;
  std::vector<Bounds> groups;
};
// How far one of them went or grew, at most; infinite where they are not the same number.
float farthestStep(const MoverPlace& before, const MoverPlace& now);

class MoverPath {
 public:
  using Mark = uint8_t;  // 0: nothing is known

  // Other things move: marks of before are void.
  void restart() { at_ = kFirst, count_ = 0.0f; }

  // One step more, in which no box of what moves went or grew by more than this [m]. `size`: that
  // of the least mover [m]. By how much all marks are to be lowered, down to 0.
  Mark advance(float distance, float size);

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

  float at_ = kFirst;   // in counts
  float count_ = 0.0f;  // [m]; 0: not known yet
};

}  // namespace lamplighter
