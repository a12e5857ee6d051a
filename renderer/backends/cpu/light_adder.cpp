#include "renderer/backends/cpu/light_adder.h"

#include <algorithm>
#include <bit>

#include "renderer/scene/light_linking.h"

namespace lamplighter::cpu {
namespace {

// Whose uses fit a key, in two bits each.
constexpr size_t kMostRows = 31;

}  // namespace

bool LightAdder::hasRoomFor(uint32_t packets) const {
  return block_.count() + static_cast<size_t>(std::popcount(packets)) <= PacketBlock::kMost;
}

void LightAdder::addPackets(int tile, uint32_t packets, const TilePlaces& places, TileLit* lit) {
  listedUses_ = 0;
  pixels_ += static_cast<uint64_t>(gbuffer_.pixelsOf(tile, packets));
  packets &= places.hit();
  const size_t base = block_.count(), firstPart = parts_.size();
  for (uint32_t rest = packets; rest != 0; rest &= rest - 1) {
    const int packet = std::countr_zero(rest);
    block_.add(gbuffer_,
               static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes);
    if (lit != nullptr) lit_.push_back({lit->of(packet), lit->stride()});
  }
  places.forEachPart(packets, [&](int packet, uint8_t lanes, uint32_t row) {
    const size_t before = static_cast<size_t>(std::popcount(packets & ((1u << packet) - 1)));
    const size_t of = static_cast<size_t>(std::ranges::find(rows_, row) - rows_.begin());
    if (of == rows_.size()) rows_.push_back(row);
    parts_.push_back({static_cast<uint8_t>(base + before), lanes, static_cast<uint16_t>(of)});
  });
  // The parts of a packet side by side, so that they come together again where they are used alike.
  std::stable_sort(parts_.begin() + static_cast<ptrdiff_t>(firstPart), parts_.end(),
                   [](const Part& a, const Part& b) { return a.packet < b.packet; });
  uses_.resize(rows_.size());
}

void LightAdder::add(const LightRecord& light, Sign sign, TilePlaces::When when) {
  counts_.lightPixels += pixels_;
  if (table_ != nullptr && light.slot >= 0) {
    if (!listAs(findUses(light.slot, when))) return;
    for (const LightUse use : {LightUse::add, LightUse::addShadowed, LightUse::takeShadow})
      sum(lists_[static_cast<size_t>(use)], use, sign, light);
    return;
  }
  listedUses_ = 0;
  lists_[0].clear();
  for (const Part& part : parts_) lists_[0].add(part.packet, part.lanes);
  if (light.link != 0 && !leftOutBy_.empty()) leaveOut(light.link);
  sum(lists_[0], light.map == nullptr ? LightUse::add : LightUse::addShadowed, sign, light);
}

void LightAdder::addAll(std::span<const LightRecord* const> lights, Sign sign,
                        TilePlaces::When when) {
  order_.clear();
  for (const LightRecord* light : lights) {
    const bool isListed = table_ != nullptr && light->slot >= 0;
    order_.emplace_back(isListed ? findUses(light->slot, when) : 0, light);
  }
  std::stable_sort(order_.begin(), order_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [uses, light] : order_) add(*light, sign, when);
}

// Takes lanes out of the first list that show what gets no light of the link.
void LightAdder::leaveOut(uint32_t link) {
  const PacketList all = lists_[0];
  lists_[0].clear();
  for (size_t k = 0; k < all.count(); ++k) {
    uint8_t lanes = *all.lanes(k);
    const size_t first = block_.first(all.packet(k));
    for (size_t i = first; i < first + kLanes; ++i)
      if (gbuffer_.hit[i] != 0 && isLeftOut(leftOutBy_[gbuffer_.object[i]], link))
        lanes &= static_cast<uint8_t>(~(1u << (i - first)));
    if (lanes != 0) lists_[0].add(all.packet(k), lanes);
  }
}

// How the light is used in each of the rows. The same in two bits for each, and a bit that is
// always set; 0 where these are too many.
uint64_t LightAdder::findUses(int slot, TilePlaces::When when) {
  uint64_t key = 1;
  for (size_t i = 0; i < rows_.size(); ++i) {
    const uint32_t row = rows_[i];
    const LightUse* of = when == TilePlaces::When::now ? table_->now(row) : table_->before(row);
    uses_[i] = of[slot];
    key = key << 2 | static_cast<uint64_t>(of[slot]);
  }
  return rows_.size() > kMostRows ? 0 : key;
}

// Lights that are used alike have the same lists. Returns whether there is anything in them.
bool LightAdder::listAs(uint64_t key) {
  static_assert(static_cast<int>(LightUse::skip) == 0);
  if (key != 0 && (key & (key - 1)) == 0) return false;
  if (key != 0 && key == listedUses_) return true;
  listedUses_ = key;
  for (PacketList& list : lists_) list.clear();
  for (const Part& part : parts_)
    lists_[static_cast<size_t>(uses_[part.row])].add(part.packet, part.lanes);
  return true;
}

void LightAdder::sum(const PacketList& packets, LightUse use, Sign sign, const LightRecord& light) {
  if (packets.count() == 0) return;
  LitOfList lit;
  const bool isKept = use != LightUse::add && light.slot >= 0 && !lit_.empty();
  const auto noted = [&](size_t k) -> uint8_t& {
    const Lit& of = lit_[packets.packet(k)];
    return of.ofSlot0[static_cast<size_t>(light.slot) * of.stride];
  };
  if (isKept && sign == Sign::takeAway) {
    for (size_t k = 0; k < packets.count(); ++k)
      lit[k] = static_cast<uint8_t>(noted(k) & *packets.lanes(k));
    return addLit(block_, packets, use, sign, light, constants_, lit);
  }
  addLight(block_, packets, use, sign, light, constants_, lit);
  if (use != LightUse::add) counts_.lookUps += packets.count() * kLanes;
  for (size_t k = 0; isKept && k < packets.count(); ++k)
    noted(k) = static_cast<uint8_t>((noted(k) & ~*packets.lanes(k)) | lit[k]);
}

}  // namespace lamplighter::cpu
