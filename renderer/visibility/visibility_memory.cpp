// Allocates the entries of the visibility database within the memory limit.
#include <algorithm>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

void VisibilityDatabase::resize(size_t slots) {
  waiting_.resize(std::max(slots, waiting_.size()));
  knowsNow_.resize(waiting_.size(), 0);
  const size_t stride = rowBytes(slots);
  if (stride == stride_) return;
  const auto fit = [&](std::vector<uint8_t>& row, uint8_t fill) {
    std::vector<uint8_t> next(stride, fill);  // allocated with exactly this size
    std::copy_n(row.begin(), std::min(row.size(), stride), next.begin());
    row.swap(next);
  };
  for (size_t object = 0; object < rows_.size(); ++object) {
    for (size_t patch = 0; patch < rows_[object].size(); ++patch) {
      Row& row = rows_[object][patch];
      // Before the first lights, not even roots had entries.
      const bool isRoot = given_[object][patch] > 0;
      if (isRoot || !row.states.empty()) fit(row.states, static_cast<uint8_t>(Occlusion::partial));
      if (!row.withoutMovers.empty()) fit(row.withoutMovers, kUnknown);
      if (!row.standsTill.empty()) fit(row.standsTill, 0);
    }
  }
  stride_ = stride;
}

std::vector<size_t> VisibilityDatabase::patchesAtLevels() const {
  if (!demand_.isForAll) return askedAtLevels_;
  std::vector<size_t> patches(1, 0);
  for (const ObjectPatches& p : patches_) {
    patches.resize(std::max(patches.size(), p.countAtLevel.size()), 0);
    for (size_t level = 0; level < p.countAtLevel.size(); ++level)
      patches[level] += p.countAtLevel[level];
  }
  return patches;
}

// Finds how many levels may have entries for rows of `stride` bytes. Depends only on the present
// patches, so the result is the same for any history. Returns whether it changed.
bool VisibilityDatabase::takeMemoryLimit(size_t stride) {
  const std::vector<size_t> patches = patchesAtLevels();
  const size_t before = levels_;
  levels_ = kAllLevels;
  size_t bytes = 0;  // of Row::states
  for (size_t level = 0; level < patches.size(); ++level) {
    const size_t more = bytes + patches[level] * stride;
    if (level > 0 && more > mostBytes_) {
      levels_ = level;
      break;
    }
    bytes = more;
  }
  const bool kept = std::exchange(keepsOthers_, 2 * bytes <= mostBytes_);
  const bool keptMarks = std::exchange(keepsMarks_, 3 * bytes <= mostBytes_);
  if ((kept && !keepsOthers_) || (keptMarks && !keepsMarks_)) forgetOthers();
  if (levels_ < before) forgetBelow();
  return levels_ != before;
}

// Done at once, so that rows which are about to be removed are not enlarged.
void VisibilityDatabase::forgetBelow() {
  for (uint32_t object = 0; object < patches_.size(); ++object) {
    const std::vector<Patch>& patches = patches_[object].patches;
    std::vector<size_t> levels(patches.size(), 0);
    for (size_t i = 0; i < patches.size(); ++i) {  // children follow their parents
      if (patches[i].parent != kNone)
        levels[i] = levels[static_cast<size_t>(patches[i].parent)] + 1;
      if (levels[i] >= levels_) rows_[object][i] = Row();
      if (levels[i] + 1 < levels_ || divided_[object][i] == 0) continue;
      divided_[object][i] = 0;
      changed_[object][i] = 1;
    }
  }
}

void VisibilityDatabase::forgetOthers() {
  for (auto& rows : rows_)
    for (Row& row : rows) {
      std::vector<uint8_t>().swap(row.withoutMovers);
      std::vector<MoverPath::Mark>().swap(row.standsTill);
    }
  path_.restart();
}

void VisibilityDatabase::lowerMarks(MoverPath::Mark by) {
  const hn::FixedTag<uint8_t, 32> bytes;
  constexpr size_t kBytes = hn::MaxLanes(bytes);
  static_assert(std::is_same_v<MoverPath::Mark, uint8_t> && kSlotsAStep % kBytes == 0);
  const auto down = hn::Set(bytes, by);
  tbb::parallel_for(size_t{0}, rows_.size(), [&](size_t object) {
    for (Row& row : rows_[object])
      for (size_t i = 0; i < row.standsTill.size(); i += kBytes) {
        uint8_t* const marks = &row.standsTill[i];
        hn::StoreU(hn::SaturatedSub(hn::LoadU(bytes, marks), down), bytes, marks);
      }
  });
}

size_t VisibilityDatabase::bytes() const {
  size_t bytes = 0;
  for (const auto& rows : rows_)
    for (const Row& row : rows)
      bytes += row.states.capacity() + row.withoutMovers.capacity() + row.standsTill.capacity();
  return bytes;
}

}  // namespace lamplighter
