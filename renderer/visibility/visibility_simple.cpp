// The most frequent updates during a drag: columns that know the state without the movers and wait
// only for the movers. Many are tested at once, without a task for each.
#include <algorithm>
#include <array>
#include <optional>

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/bit_iteration.h"
#include "renderer/visibility/visibility_update.h"

namespace lamplighter {
namespace {

constexpr hn::FixedTag<uint8_t, 32> kBytes;

// Bit mask of those of 64 bytes for which a condition is true.
template <typename Is>
uint64_t which(const uint8_t* bytes, const Is& is) {
  return bitsOf(is(hn::LoadU(kBytes, bytes))) | uint64_t{bitsOf(is(hn::LoadU(kBytes, bytes + 32)))}
                                                    << 32;
}

uint64_t equal(const uint8_t* bytes, uint8_t value) {
  return which(bytes, [&](auto v) { return hn::Eq(v, hn::Set(kBytes, value)); });
}
uint64_t atLeast(const uint8_t* bytes, uint8_t value) {
  return which(bytes, [&](auto v) { return hn::Eq(hn::Max(v, hn::Set(kBytes, value)), v); });
}

}  // namespace

// A part that had no entries of its own gets tasks for all partial lights.
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

// Keeps the columns whose entries are partial and stay so; they are tested again in the parts of
// the patch. Makes tasks for entries that change or are not known well enough.
void VisibilityDatabase::Update::checkSimple(uint32_t object, int patch, size_t first,
                                             std::span<uint64_t> simple) {
  const ObjectPatches& patches = db_.patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  Row& row = db_.rows_[object][static_cast<size_t>(patch)];
  const size_t before = tasks_.size();
  const auto makeTask = [&](size_t slot) -> Task& {
    simple[slot / 64] &= ~(uint64_t{1} << slot % 64);
    Task& task = tasks_.emplace_back();
    task.column = simpleColumns_->bySlot[slot];
    task.slot = static_cast<int>(slot);
    task.work = Work::check;
    return task;
  };
  const auto makeFound = [&](size_t slot, Occlusion state) {
    Task& task = makeTask(slot);
    task.isFound = true;
    task.state = state;
  };
  std::optional<PatchRegion> region;
  std::array<MoverShadows::Question, MoverShadows::kLights> questions;
  size_t count = 0;
  const auto ask = [&] {
    if (!region) region.emplace(scene_, object, patches, p);
    const MoverShadows::Answer answer =
        simpleColumns_->shadows.of(*region, {questions.data(), count});
    for (size_t i = 0; i < count; ++i) {
      const size_t slot = questions[i].slot;
      const bool isMet = (answer.met >> i & 1) != 0;
      if (isMet) row.withoutMovers[slot] = noneAndMet(answer.hints[i]);
      if (!row.standsTill.empty()) row.standsTill[slot] = db_.path_.markAfter(answer.slack[i]);
      const Occlusion state = isMet ? Occlusion::partial : Occlusion::none;
      if (row.states[slot] != static_cast<uint8_t>(state)) {
        makeFound(slot, state);
      } else if (!isMet) {
        simple[slot / 64] &= ~(uint64_t{1} << slot % 64);
      }
    }
    count = 0;
  };
  const bool isKnown = !row.withoutMovers.empty() && p.chart != kNone;
  if (isKnown && db_.keepsMarks_ && row.standsTill.empty()) row.standsTill.assign(db_.stride_, 0);
  const bool passesDown = db_.isDivided(object, patch);
  for (size_t w = 0; w < simple.size(); ++w) {
    if (simple[w] == 0) continue;
    uint64_t unknown = simple[w], none = 0;
    if (isKnown) {
      static_assert(kSlotsAStep % 64 == 0, "rows have room for whole words");
      const uint8_t* without = &row.withoutMovers[64 * w];
      const uint64_t some = simple[w] & ~equal(without, static_cast<uint8_t>(Occlusion::full));
      const uint64_t partial = some & equal(without, static_cast<uint8_t>(Occlusion::partial));
      unknown = some & equal(without, kUnknown);
      none = some & ~unknown & ~partial;
      unknown &= simpleColumns_->reaches.mayFallOn(w, unknown, p.centre, p.radius);
      // Entries that are still valid are unchanged.
      uint64_t stands = 0;
      if (!row.standsTill.empty())
        stands = none & atLeast(&row.standsTill[64 * w], db_.path_.now());
      none &= ~stands;
      const uint64_t isNone = equal(&row.states[64 * w], static_cast<uint8_t>(Occlusion::none));
      // Entries that are partial independent of the movers remain only for the parts of the patch;
      // shadows almost always reach one of the parts.
      simple[w] = (passesDown ? partial : 0) | unknown | none | (stands & ~isNone);
    }
    forEachBit(none, [&](size_t i) {
      const size_t slot = 64 * w + i;
      questions[count] = {slot, hintOf(row.withoutMovers[slot])};
      if (++count == questions.size()) ask();
    });
    forEachBit(unknown, [&](size_t i) { makeTask(64 * w + i); });
  }
  if (count > 0) ask();
  if (tasks_.size() == before) return;
  std::sort(tasks_.begin() + static_cast<ptrdiff_t>(first), tasks_.end(),
            [](const Task& a, const Task& b) { return a.slot < b.slot; });
}

}  // namespace lamplighter
