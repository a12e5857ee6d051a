#include "renderer/backends/cpu/irradiance/shadow_mask_cache.h"

#include <algorithm>
#include <array>
#include <bit>

namespace lamplighter::cpu {
namespace {

// The index of a packet among these packets.
size_t rankOf(uint32_t packets, int packet) {
  return static_cast<size_t>(std::popcount(packets & ((uint32_t{1} << packet) - 1)));
}

}  // namespace

size_t ShadowMaskCache::stride() const { return static_cast<size_t>(std::popcount(packets_)); }

uint8_t* ShadowMaskCache::of(int packet) { return &lanes_[rankOf(packets_, packet)]; }

void ShadowMaskCache::keep(uint32_t packets, size_t slots) {
  const size_t before = stride(), now = static_cast<size_t>(std::popcount(packets));
  if (packets == packets_) {
    if (lanes_.size() < slots * now) lanes_.resize(slots * now, 0);
    return;
  }
  struct Move {
    size_t from, to;
  };
  std::array<Move, 32> moves;
  size_t count = 0;
  for (uint32_t rest = packets & packets_; rest != 0; rest &= rest - 1) {
    const int packet = std::countr_zero(rest);
    moves[count++] = {rankOf(packets_, packet), rankOf(packets, packet)};
  }
  std::vector<uint8_t> lanes(slots * now, 0);
  const size_t known = before == 0 ? 0 : std::min(slots, lanes_.size() / before);
  for (size_t slot = 0; slot < known; ++slot)
    for (size_t m = 0; m < count; ++m)
      lanes[slot * now + moves[m].to] = lanes_[slot * before + moves[m].from];
  packets_ = packets;
  lanes_ = std::move(lanes);
}

}  // namespace lamplighter::cpu
