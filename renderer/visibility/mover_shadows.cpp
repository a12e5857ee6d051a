#include "renderer/visibility/mover_shadows.h"

#include <algorithm>
#include <bit>

#include "renderer/visibility/bits.h"

namespace lamplighter {
namespace {

PyramidBatch::Mask bit(size_t i) { return PyramidBatch::Mask{1} << i; }

// The last is filled up with its last box.
std::vector<BoxBatch> batchesOf(std::span<const Bounds> boxes) {
  std::vector<BoxBatch> batches((boxes.size() + BoxBatch::kBoxes - 1) / BoxBatch::kBoxes);
  for (size_t i = 0; i < batches.size() * BoxBatch::kBoxes; ++i)
    batches[i / BoxBatch::kBoxes].set(i % BoxBatch::kBoxes, boxes[std::min(i, boxes.size() - 1)]);
  return batches;
}

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
    const std::span<const Bounds> groups = occluders.groups(object);
    Mover& mover = movers_.emplace_back();
    mover.caster = occluders.caster(object);
    mover.groups = groups.size();
    mover.firstGroup = groups_;
    mover.batches = batchesOf(groups);
    std::vector<Bounds> around(mover.batches.size());
    for (size_t g = 0; g < groups.size(); ++g) around[g / BoxBatch::kBoxes].add(groups[g]);
    for (const Bounds& b : around) mover.box.add(b);
    mover.around = batchesOf(around);
    groups_ += groups.size();
  }
  hinted_.resize(std::min<size_t>(groups_, kHints));
  for (size_t m = 0; m < movers.size(); ++m) {
    const std::span<const Bounds> groups = occluders.groups(movers[m]);
    for (size_t g = 0; g < groups.size(); ++g) hinted_[hintOf(m, g)] = {groups[g], m};
  }
}

int MoverShadows::firstMet(const Mover& mover, const PyramidBatch& pyramids, size_t light) const {
  for (size_t a = 0; a < mover.around.size(); ++a) {
    for (uint32_t some = pyramids.mayMeetSome(light, mover.around[a]); some != 0;
         some &= some - 1) {
      const size_t batch = a * BoxBatch::kBoxes + static_cast<size_t>(std::countr_zero(some));
      if (batch >= mover.batches.size()) break;
      const uint32_t met = pyramids.mayMeetSome(light, mover.batches[batch]);
      if (met == 0) continue;
      const size_t group = batch * BoxBatch::kBoxes + static_cast<size_t>(std::countr_zero(met));
      return static_cast<int>(std::min(group, mover.groups - 1));
    }
  }
  return kNone;
}

MoverShadows::Answer MoverShadows::of(const PatchRegion& region,
                                      std::span<const Question> lights) const {
  std::array<const PyramidApex*, kLights> apices;
  for (size_t i = 0; i < lights.size(); ++i) apices[i] = &lights_[lights[i].slot].apex;
  const PyramidBatch pyramids({apices.data(), lights.size()}, region);
  Answer answer;
  const auto take = [&](size_t i, size_t mover, Hint hint) {
    if (!reaches(lights[i].slot, mover, region)) return;
    answer.met |= bit(i);
    answer.hints[i] = hint;
  };
  for (size_t m = 0; m < movers_.size(); ++m) {
    const Mover& mover = movers_[m];
    PyramidBatch::Mask open =
        pyramids.mayMeetSphere(mover.caster.box.centre(), 1.001f * mover.caster.radius);
    open &= ~answer.met;
    if (open != 0) open &= pyramids.mayMeet(mover.box);
    if (open == 0) continue;
    // Most are met where they were.
    BoxBatch hinted;
    PyramidBatch::Mask known = 0;
    forEachBit(open, [&](size_t i) {
      const Hint hint = lights[i].hint;
      if (hint >= hinted_.size() || hinted_[hint].mover != m) return;
      hinted.set(i, hinted_[hint].box);
      known |= bit(i);
    });
    if (known != 0) known &= pyramids.mayMeetOwn(hinted);
    forEachBit(known, [&](size_t i) { take(i, m, lights[i].hint); });
    forEachBit(open & ~known, [&](size_t i) {
      const int group = firstMet(mover, pyramids, i);
      if (group != kNone) take(i, m, hintOf(m, static_cast<size_t>(group)));
    });
  }
  return answer;
}

}  // namespace lamplighter
