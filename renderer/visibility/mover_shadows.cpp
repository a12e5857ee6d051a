#include "renderer/visibility/mover_shadows.h"

#include <algorithm>
#include <limits>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/bits.h"

namespace lamplighter {
namespace {

PyramidBatch::Mask bit(size_t i) { return PyramidBatch::Mask{1} << i; }

}  // namespace

MoverShadows::MoverShadows(const Occluders& occluders, std::span<const uint32_t> movers,
                           std::span<const shared::Vpl> lights)
    : isUseful_(!movers.empty() && std::all_of(movers.begin(), movers.end(), [&](uint32_t mover) {
        return occluders.isOfGroups(mover) && !occluders.mayHide(mover);
      })) {
  if (!isUseful_) return;
  lights_.reserve(lights.size());
  reaches_.reserve(lights.size() * movers.size());
  for (const shared::Vpl& vpl : lights) {
    lights_.push_back({PyramidApex(vpl), vpl.position.w == shared::kVplDirectional});
    for (const uint32_t mover : movers) reaches_.emplace_back(vpl, occluders.caster(mover));
  }
  for (const uint32_t object : movers) {
    const size_t firstHint =
        movers_.empty() ? 0 : movers_.back().firstHint + movers_.back().groups.size();
    movers_.push_back({occluders.caster(object), BoxBatches(occluders.groups(object)), firstHint});
    for (const vec3& corner : {movers_.back().caster.box.min, movers_.back().caster.box.max})
      rounding_ = std::max(rounding_, rayEpsilon(corner));
  }
  for (size_t m = 0; m < movers.size(); ++m) {
    ShadowReaches& all = allReaches_.emplace_back(lights.size());
    for (size_t slot = 0; slot < lights.size(); ++slot)
      if (!lights_[slot].isParallel) all.set(slot, reachOf(slot, m));
  }
}

MoverShadows::Answer MoverShadows::of(const PatchRegion& region,
                                      std::span<const Question> lights) const {
  std::array<const PyramidApex*, kLights> apices;
  for (size_t i = 0; i < lights.size(); ++i) apices[i] = &lights_[lights[i].slot].apex;
  const PyramidBatch pyramids(LightLanes({apices.data(), lights.size()}), region);
  Answer answer;
  answer.slack.fill(std::numeric_limits<float>::max());
  for (size_t m = 0; m < movers_.size(); ++m) {
    const Mover& mover = movers_[m];
    PyramidBatch::Depths sphere, box;
    PyramidBatch::Mask open =
        pyramids.mayMeetSphere(mover.caster.box.centre(), 1.001f * mover.caster.radius, sphere);
    PyramidBatch::Mask outside = pyramids.all() & ~open & ~answer.met;
    forEachBit(outside, [&](size_t i) { answer.slack[i] = std::min(answer.slack[i], -sphere[i]); });
    open &= ~answer.met;
    if (open == 0) continue;
    outside = open;
    open &= pyramids.mayMeet(mover.groups.bounds(), box);
    outside &= ~open;
    forEachBit(outside, [&](size_t i) { answer.slack[i] = std::min(answer.slack[i], -box[i]); });
    if (open == 0) continue;
    const auto take = [&](size_t i, Hint hint, float depth) {
      const ShadowReach& reach = reachOf(lights[i].slot, m);
      // With one mover that was asked before.
      if (movers_.size() > 1 && !reach.mayFallOn(region.centre, region.radius)) {
        answer.slack[i] = 0.0f;
        return;
      }
      answer.met |= bit(i);
      answer.hints[i] = hint;
      answer.slack[i] = std::min({sphere[i], depth, reach.slack(region.centre, region.radius)});
    };
    // Most are met where they were.
    forEachBit(open, [&](size_t i) {
      const PyramidBatch::Found found = pyramids.find(i, mover.groups, hinted(m, lights[i].hint));
      if (found.batch != kNone) {
        const size_t hint = mover.firstHint + static_cast<size_t>(found.batch);
        take(i, static_cast<Hint>(std::min<size_t>(hint, kNoHint)), found.depth);
      } else {
        answer.slack[i] = std::min(answer.slack[i], -found.depth);
      }
    });
  }
  // What sums of such places are rounded by.
  for (size_t i = 0; i < lights.size(); ++i)
    answer.slack[i] -=
        std::max({rounding_, region.rounding, lights_[lights[i].slot].apex.rounding});
  return answer;
}

}  // namespace lamplighter
