// Most of what a drag asks of the visibility database: columns that know what all others do at a
// patch and only wait for the movers, many at a time and without a task for each.
#define HWY_DISABLE_PCLMUL_AES 1  // see pyramid_sides.h

#include <algorithm>
#include <array>
#include <optional>

#include <hwy/highway.h>

#include "renderer/visibility/bits.h"
#include "renderer/visibility/visibility_update.h"

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Which of 64 bytes have a value.
uint64_t equal(const uint8_t* bytes, uint8_t value) {
  const hn::FixedTag<uint8_t, 32> tag;
  uint64_t mask = 0;
  for (size_t i = 0; i < 64; i += 32) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Eq(hn::LoadU(tag, bytes + i), hn::Set(tag, value)), bits);
    uint64_t some = 0;
    for (size_t b = 0; b < 4; ++b) some |= uint64_t{bits[b]} << (8 * b);
    mask |= some << i;
  }
  return mask;
}

}  // namespace

// A part that was not apart has all lights that are partial as tasks.
bool VisibilityDatabase::Update::passSimpleDown(size_t level, bool wasDivided) {
  simple_.resize(std::max(simple_.size(), (level + 2) * simpleWords_));
  const std::span<uint64_t> from = simpleAt(level), to = simpleAt(level + 1);
  bool any = false;
  for (size_t i = 0; i < simpleWords_; ++i) {
    to[i] = wasDivided ? from[i] : 0;
    any = any || to[i] != 0;
  }
  return any;
}

// Leaves those that are partial and stay so, which are to be checked below; makes tasks of those
// that change or are not known well enough.
void VisibilityDatabase::Update::checkSimple(uint32_t object, int patch, size_t first,
                                             std::span<uint64_t> simple) {
  const ObjectPatches& patches = db_.patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  Row& row = db_.rows_[object][static_cast<size_t>(patch)];
  const size_t before = tasks_.size();
  const auto makeTask = [&](size_t slot) {
    simple[slot / 64] &= ~(uint64_t{1} << slot % 64);
    Task& task = tasks_.emplace_back();
    task.column = simpleColumns_->bySlot[slot];
    task.slot = static_cast<int>(slot);
    task.work = Work::check;
  };
  std::optional<PatchRegion> region;
  std::array<MoverShadows::Question, MoverShadows::kLights> open;
  size_t openCount = 0;
  const auto ask = [&] {
    if (!region) region.emplace(scene_, object, patches, p);
    const MoverShadows::Answer answer =
        simpleColumns_->shadows.of(*region, {open.data(), openCount});
    for (size_t i = 0; i < openCount; ++i) {
      const size_t slot = open[i].slot;
      const bool isMet = (answer.met >> i & 1) != 0;
      if (isMet) row.withoutMovers[slot] = noneAndMet(answer.hints[i]);
      const Occlusion state = isMet ? Occlusion::partial : Occlusion::none;
      if (row.states[slot] != static_cast<uint8_t>(state)) {
        makeTask(slot);
      } else if (!isMet) {
        simple[slot / 64] &= ~(uint64_t{1} << slot % 64);
      }
    }
    openCount = 0;
  };
  const bool isKnown = !row.withoutMovers.empty() && p.chart != kNone;
  for (size_t w = 0; w < simple.size(); ++w) {
    if (simple[w] == 0) continue;
    uint64_t unknown = simple[w], partial = 0;
    if (isKnown) {
      static_assert(kSlotsAStep % 64 == 0, "rows have room for whole words");
      const uint8_t* others = &row.withoutMovers[64 * w];
      uint64_t some = simple[w] & ~equal(others, static_cast<uint8_t>(Occlusion::full));
      for (size_t i = 0; i < 64; i += 8)
        if ((some >> i & 0xff) != 0)
          some &= ~(uint64_t{0xff} << i) |
                  uint64_t{simpleColumns_->reaches.mayFallOn((64 * w + i) / 8, p.centre, p.radius)}
                      << i;
      simple[w] = some;
      unknown = some & equal(others, kUnknown);
      partial = equal(others, static_cast<uint8_t>(Occlusion::partial));
    }
    forEachBit(simple[w] & ~unknown & ~partial, [&](size_t i) {
      const size_t slot = 64 * w + i;
      open[openCount] = {slot, hintOf(row.withoutMovers[slot])};
      if (++openCount == open.size()) ask();
    });
    forEachBit(unknown, [&](size_t i) { makeTask(64 * w + i); });
  }
  if (openCount > 0) ask();
  if (tasks_.size() == before) return;
  std::sort(tasks_.begin() + static_cast<ptrdiff_t>(first), tasks_.end(),
            [](const Task& a, const Task& b) { return a.slot < b.slot; });
}

}  // namespace lamplighter
