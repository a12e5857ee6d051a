// Allocates ranges of numbers for objects that are added and removed, so that the others keep their
// numbers.
#pragma once

#include <cstdint>
#include <map>

namespace lamplighter {

class NumberRanges {
 public:
  // Allocates the lowest `count` consecutive free numbers and returns the first.
  uint32_t take(uint32_t count) {
    if (count == 0) return 0;
    for (auto it = free_.begin(); it != free_.end(); ++it) {
      if (it->second < count) continue;
      const auto [first, size] = *it;
      free_.erase(it);
      if (size > count) free_.emplace(first + count, size - count);
      return first;
    }
    const uint32_t first = end_;
    end_ += count;
    return first;
  }
  void giveBack(uint32_t first, uint32_t count) {
    if (count == 0) return;
    auto next = free_.lower_bound(first);
    if (next != free_.end() && first + count == next->first) {
      count += next->second;
      next = free_.erase(next);
    }
    if (next != free_.begin()) {
      const auto before = std::prev(next);
      if (before->first + before->second == first) {
        before->second += count;
        return;
      }
    }
    free_.emplace_hint(next, first, count);
  }
  // One more than the largest number so far.
  uint32_t end() const { return end_; }

 private:
  std::map<uint32_t, uint32_t> free_;  // first → count; neighbours are joined
  uint32_t end_ = 0;
};

}  // namespace lamplighter
