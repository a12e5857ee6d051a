#include "renderer/backends/cpu/irradiance/light_adder.h"

#include <algorithm>
#include <bit>

#include "renderer/scene/light_linking.h"

namespace lamplighter::cpu {
namespace {

// Up to this number of rows the modes fit into one number, two bits each; beyond it, this value is
// used.
constexpr size_t kMostRows = 31;
constexpr uint64_t kManyRows = 0;

}  // namespace

bool LightAdder::hasRoomFor(uint32_t packets) const {
  return block_.count() + static_cast<size_t>(std::popcount(packets)) <= PacketBlock::kMost;
}

void LightAdder::addPackets(int tile, uint32_t packets, const TilePlaces& places,
                            ShadowMaskCache* lit) {
  listedUses_ = 0;
  pixels_ += static_cast<uint64_t>(gbuffer_.pixelsOf(tile, packets));
  packets &= places.hit();
  const size_t base = block_.count();
  for (uint32_t rest = packets; rest != 0; rest &= rest - 1) {
    const int packet = std::countr_zero(rest);
    block_.add(gbuffer_,
               static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes);
    if (lit != nullptr) lit_.push_back({lit->of(packet), lit->stride()});
  }
  places.forEachPart(packets, [&](int packet, uint8_t lanes, uint32_t row) {
    const size_t before = static_cast<size_t>(std::popcount(packets & ((1u << packet) - 1)));
    const size_t of = static_cast<size_t>(std::ranges::find(rows_, row) - rows_.begin());
    if (of == rows_.size()) {
      rows_.push_back(row);
      inRows_.emplace_back();
    }
    inRows_[of].of[base + before] |= lanes;
  });
  uses_.resize(rows_.size());
}

void LightAdder::add(const LightRecord& light, Sign sign, TilePlaces::When when) {
  const bool isListed = table_ != nullptr && light.slot >= 0;
  addAs(isListed ? findUses(light.slot, when) : kManyRows, light, sign, when);
}

void LightAdder::addAll(std::span<const LightRecord* const> lights, Sign sign,
                        TilePlaces::When when) {
  order_.clear();
  for (const LightRecord* light : lights) {
    const bool isListed = table_ != nullptr && light->slot >= 0;
    order_.emplace_back(isListed ? findUses(light->slot, when) : kManyRows, light);
  }
  std::sort(order_.begin(), order_.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [uses, light] : order_) addAs(uses, *light, sign, when);
}

// uses: from findUses(), for a light in the table.
void LightAdder::addAs(uint64_t uses, const LightRecord& light, Sign sign, TilePlaces::When when) {
  counts_.lightPixels += pixels_;
  if (table_ != nullptr && light.slot >= 0) {
    if (uses == kManyRows) findUses(light.slot, when);
    if (!listAs(uses)) return;
    for (const ShadowMode use :
         {ShadowMode::add, ShadowMode::addShadowed, ShadowMode::subtractShadow})
      sum(lists_[static_cast<size_t>(use)], use, sign, light);
    return;
  }
  listedUses_ = kManyRows;
  PacketLanes lanes;
  for (const PacketLanes& row : inRows_) lanes.add(row);
  if (light.link != 0 && !leftOutBy_.empty()) leaveOut(light.link, lanes);
  lists_[0].take(lanes);
  sum(lists_[0], light.map == nullptr ? ShadowMode::add : ShadowMode::addShadowed, sign, light);
}

void LightAdder::replace(const PlaceTable::Staying& light) {
  const LightRecord& is = *light.is;
  counts_.lightPixels += pixels_;
  if (!listAs(findUses(is.slot, TilePlaces::When::untouched))) return;
  for (const ShadowMode use : {ShadowMode::addShadowed, ShadowMode::subtractShadow}) {
    const PacketList& packets = lists_[static_cast<size_t>(use)];
    ShadowMasks lit;
    findLit(packets, is.slot, lit);
    replaceMasked(block_, packets, use, *light.was, is, constants_, lit);
  }
}

uint8_t& LightAdder::noteOf(size_t packet, int slot) const {
  const Lit& of = lit_[packet];
  return of.ofSlot0[static_cast<size_t>(slot) * of.stride];
}

// The lanes, of those in `packets`, where the light was added.
void LightAdder::findLit(const PacketList& packets, int slot, ShadowMasks& lit) const {
  for (size_t k = 0; k < packets.count(); ++k)
    lit[k] = static_cast<uint8_t>(noteOf(packets.packet(k), slot) & *packets.lanes(k));
}

// Clears the lanes of objects that light linking excludes.
void LightAdder::leaveOut(uint32_t link, PacketLanes& lanes) const {
  for (size_t k = 0; k < block_.count(); ++k) {
    const size_t first = block_.first(k);
    for (size_t i = first; i < first + kLanes; ++i)
      if (gbuffer_.hit[i] != 0 && isLeftOut(leftOutBy_[gbuffer_.object[i]], link))
        lanes.of[k] &= static_cast<uint8_t>(~(1u << (i - first)));
  }
}

// Finds the shadow mode of the light in each row: writes it to uses_ and returns all as two bits
// each, after a leading 1.
uint64_t LightAdder::findUses(int slot, TilePlaces::When when) {
  using When = TilePlaces::When;
  const auto find = [&](auto&& isMeant) {
    uint64_t uses = 1;
    for (size_t i = 0; i < rows_.size(); ++i) {
      const uint32_t row = rows_[i];
      const ShadowMode* of = when == When::before ? table_->before(row) : table_->now(row);
      uses_[i] = isMeant(row) ? of[slot] : ShadowMode::skip;
      uses = uses << 2 | static_cast<uint64_t>(uses_[i]);
    }
    return rows_.size() > kMostRows ? kManyRows : uses;
  };
  const uint8_t* touched = when == When::now ? nullptr : table_->touched(slot);
  if (touched == nullptr) return find([](uint32_t) { return true; });
  return find([&](uint32_t row) { return (touched[row] != 0) != (when == When::untouched); });
}

// Fills lists_ for these modes. Lights with equal modes share lists. For kManyRows it uses uses_.
// Returns whether any list has entries.
bool LightAdder::listAs(uint64_t uses) {
  static_assert(static_cast<int>(ShadowMode::skip) == 0);
  if (uses != kManyRows && std::has_single_bit(uses)) return false;
  if (uses != kManyRows && uses == listedUses_) return true;
  listedUses_ = uses;
  std::array<PacketLanes, 4> lanes;
  for (size_t i = rows_.size(); i-- > 0; uses >>= 2)
    lanes[listedUses_ == kManyRows ? static_cast<size_t>(uses_[i]) : uses & 3].add(inRows_[i]);
  for (size_t use = 1; use < lanes.size(); ++use) lists_[use].take(lanes[use]);
  return true;
}

void LightAdder::sum(const PacketList& packets, ShadowMode use, Sign sign,
                     const LightRecord& light) {
  if (packets.count() == 0) return;
  ShadowMasks lit;
  const bool isKept = use != ShadowMode::add && light.slot >= 0 && !lit_.empty();
  if (isKept && sign == Sign::takeAway) {
    findLit(packets, light.slot, lit);
    return addMasked(block_, packets, use, sign, light, constants_, lit);
  }
  addLight(block_, packets, use, sign, light, constants_, lit);
  if (use != ShadowMode::add) counts_.lookUps += packets.count() * kLanes;
  for (size_t k = 0; isKept && k < packets.count(); ++k) {
    uint8_t& note = noteOf(packets.packet(k), light.slot);
    note = static_cast<uint8_t>((note & ~*packets.lanes(k)) | lit[k]);
  }
}

}  // namespace lamplighter::cpu
