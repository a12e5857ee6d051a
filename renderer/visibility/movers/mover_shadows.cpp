#include "renderer/visibility/movers/mover_shadows.h"

#include <algorithm>
#include <limits>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/occlusion/bit_iteration.h"

namespace lamplighter {
namespace {

using Mask = LightMask;

// For how many further steps a result should stay valid on a straight path. With a larger value few
// boxes have enough depth.
constexpr float kStepsToStand = 1.05f;

Mask bit(size_t i) { return Mask{1} << i; }

}  // namespace

struct MoverShadows::Asked {
  const PatchRegion& region;
  std::span<const Question> lights;
  const PyramidBatch& pyramids;
};

MoverShadows::MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
                           std::span<const shared::Vpl> lights, const MoverPath& path)
    : isUseful_(!movers.empty() && std::all_of(movers.begin(), movers.end(),
                                               [&](uint32_t mover) {
                                                 return occluders.isOfGroups(mover) &&
                                                        !occluders.mayHide(mover);
                                               })),
      metric_(path.metric()),
      enough_(path.metric() == MotionMetric() ? 0.0f : kStepsToStand * path.lastStep()),
      turn_(path.steps()) {
  if (!isUseful_) return;
  lights_.reserve(lights.size());
  cones_.reserve(lights.size() * movers.size());
  for (const shared::Vpl& vpl : lights) {
    lights_.emplace_back(vpl);
    for (const uint32_t mover : movers)
      cones_.push_back(ShadowVolume(vpl, occluders.caster(mover)).cone());
  }
  size_t boxes = 0;
  for (const uint32_t object : movers) boxes += occluders.groups(object).size();
  // One more hint per mover, for the remainder of its boxes.
  boxesAHint_ = boxes / (kHints - std::min<size_t>(movers.size(), kHints / 2)) + 1;
  size_t firstHint = 0;
  for (const uint32_t object : movers) {
    movers_.push_back({occluders.caster(object), BoxBatches(occluders.groups(object)), firstHint});
    firstHint += movers_.back().groups.size() / boxesAHint_ + 1;
    for (const vec3& corner : {movers_.back().caster.box.min, movers_.back().caster.box.max})
      rounding_ = std::max(rounding_, rayEpsilon(corner));
  }
}

MoverShadows::Hint MoverShadows::hintOf(size_t mover, int box) const {
  const size_t hint = movers_[mover].firstHint + static_cast<size_t>(box) / boxesAHint_;
  return static_cast<Hint>(std::min<size_t>(hint, kNoHint));
}

// Tests the boxes to which the hints of the lights refer. `depths` gets the largest depth per
// light. Returns the lights that meet a box.
Mask MoverShadows::askWhereHinted(const Asked& asked, size_t mover, Mask open,
                                  PyramidBatch::Depths& depths, Answer& answer) const {
  const Mover& m = movers_[mover];
  const size_t hints = (m.groups.size() - 1) / boxesAHint_ + 1;
  PyramidBatch::Indices first{};
  Mask hinted = 0;
  forEachBit(open, [&](size_t i) {
    const Hint hint = asked.lights[i].hint;
    if (hint == kNoHint || hint < m.firstHint || hint - m.firstHint >= hints) return;
    first[i] = static_cast<int32_t>((hint - m.firstHint) * boxesAHint_);
    answer.hints[i] = hint;
    hinted |= bit(i);
  });
  if (hinted == 0) return 0;
  Mask met = 0;
  depths.fill(-std::numeric_limits<float>::max());
  const auto last = static_cast<int32_t>(m.groups.size()) - 1;
  for (size_t k = 0; k < boxesAHint_; ++k) {
    PyramidBatch::Indices boxes;
    for (size_t i = 0; i < kLights; ++i)
      boxes[i] = std::min(first[i] + static_cast<int32_t>(k), last);
    PyramidBatch::Depths some;
    met |= asked.pyramids.mayMeetEach(m.groups, boxes, some);
    for (size_t i = 0; i < kLights; ++i) depths[i] = std::max(depths[i], some[i]);
  }
  return met & hinted;
}

void MoverShadows::ask(const Asked& asked, size_t mover, Answer& answer) const {
  const Mover& m = movers_[mover];
  const PyramidBatch& pyramids = asked.pyramids;
  PyramidBatch::Depths sphere, depths;
  const Mask wanted = pyramids.all() & ~answer.met;
  Mask open =
      wanted & pyramids.mayMeetSphere(m.caster.box.centre(), 1.001f * m.caster.radius, sphere);
  forEachBit(wanted & ~open,
             [&](size_t i) { answer.slack[i] = std::min(answer.slack[i], -sphere[i]); });
  if (open == 0) return;
  ShadowVolumeX8 reaches;
  for (size_t i = 0; i < asked.lights.size(); ++i)
    reaches.set(i, cones_[asked.lights[i].slot * movers_.size() + mover]);
  const Mask reached = reaches.mayFallOn(asked.region.centre, asked.region.radius);
  forEachBit(open & ~reached, [&](size_t i) { answer.slack[i] = 0.0f; });
  open &= reached;
  if (open == 0) return;
  // Most lights meet the mover where they met it before, but with little depth for some.
  Mask met = askWhereHinted(asked, mover, open, depths, answer);
  forEachBit(open, [&](size_t i) {
    const bool isMet = (met >> i & 1) != 0;
    if (isMet && (depths[i] >= enough_ || !looksFurther(asked.lights[i].slot))) return;
    const PyramidBatch::Found found = pyramids.find(i, m.groups, enough_);
    if (found.box == kNone) {
      answer.slack[i] = std::min(answer.slack[i], -found.depth);
      return;
    }
    met |= bit(i);
    depths[i] = found.depth;
    answer.hints[i] = hintOf(mover, found.box);
  });
  PyramidBatch::Depths ofReach;
  reaches.slack(asked.region.centre, asked.region.radius, ofReach);
  answer.met |= met;
  forEachBit(met, [&](size_t i) {
    answer.slack[i] = std::min({sphere[i], depths[i], ofReach[i]});
  });
}

MoverShadows::Answer MoverShadows::of(const PatchRegion& region,
                                      std::span<const Question> lights) const {
  std::array<const PyramidApex*, kLights> apices;
  for (size_t i = 0; i < lights.size(); ++i) apices[i] = &lights_[lights[i].slot];
  PyramidBatch pyramids(LightPacket({apices.data(), lights.size()}), region);
  pyramids.weighBy(metric_);
  Answer answer;
  answer.slack.fill(std::numeric_limits<float>::max());
  for (size_t m = 0; m < movers_.size(); ++m) ask({region, lights, pyramids}, m, answer);
  // Subtracts the rounding error of sums of such positions.
  for (size_t i = 0; i < lights.size(); ++i)
    answer.slack[i] -= std::max({rounding_, region.rounding, lights_[lights[i].slot].rounding});
  return answer;
}

}  // namespace lamplighter
