#include "renderer/backends/cpu/irradiance/tile_places.h"

#include <algorithm>
#include <cstring>

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"

namespace lamplighter::cpu {
namespace {

// Whether a point certainly lies in the leaf, if another point of its triangle does.
bool liesIn(const ObjectPatches& patches, int leaf, const vec3& position) {
  const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
  if (patch.chart == kNone) return true;
  const vec2 p = patches.charts[static_cast<size_t>(patch.chart)].project(position);
  return p.x >= patch.min.x && p.x < patch.max.x && p.y >= patch.min.y && p.y < patch.max.y;
}

// The same for all pixels of a packet.
bool lieIn(const ObjectPatches& patches, int leaf, const GBuffer& g, size_t first) {
  const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
  if (patch.chart == kNone) return true;
  const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
  const FloatTag tag;
  const auto load = [&](const std::vector<float>& v) { return hn::LoadU(tag, &v[first]); };
  const auto way = SimdVec3<Floats8>{load(g.px), load(g.py), load(g.pz)} - broadcast(chart.origin);
  const Floats8 x = dotUnfused(way, broadcast(chart.tangent));
  const Floats8 y = dotUnfused(way, broadcast(chart.bitangent));
  const auto within = [](Floats8 v, float low, float high) {
    return hn::And(hn::Ge(v, broadcast(low)), hn::Lt(v, broadcast(high)));
  };
  return hn::AllTrue(
      tag, hn::And(within(x, patch.min.x, patch.max.x), within(y, patch.min.y, patch.max.y)));
}

// Whether all pixels of a packet show the same surface as this one.
bool showSame(const GBuffer& g, size_t first, size_t pixel) {
  uint64_t hits = 0;
  static_assert(sizeof(hits) == kLanes);
  std::memcpy(&hits, &g.hit[first], sizeof(hits));
  if (hits != 0x0101010101010101) return false;
  const hn::FixedTag<uint32_t, kLanes> tag;
  const auto are = [&](const std::vector<uint32_t>& v) {
    return hn::Eq(hn::LoadU(tag, &v[first]), hn::Set(tag, v[pixel]));
  };
  return hn::AllTrue(tag, hn::And(are(g.object), are(g.triangle)));
}

}  // namespace

void PlaceTable::reset(size_t slots) {
  slots_ = slots;
  rowOf_.clear();
  places_.clear();
  now_.clear();
  before_.clear();
  changed_.clear();
  isKnown_.clear();
  touched_.clear();
}

uint32_t PlaceTable::rowOf(const Place& place) {
  const auto [it, isNew] = rowOf_.emplace(place, static_cast<uint32_t>(places_.size()));
  if (isNew) places_.push_back(place);
  return it->second;
}

void PlaceTable::update(const PatchLights& lights, const std::vector<bool>& inUse) {
  now_.resize(places_.size() * slots_);
  before_.resize(now_.size());
  changed_.resize(places_.size());
  isKnown_.resize(places_.size(), 0);
  spheres_.resize(places_.size());
  tbb::parallel_for(size_t{0}, places_.size(), [&](size_t row) {
    changed_[row].clear();
    const bool wasKnown = isKnown_[row] != 0;
    isKnown_[row] = inUse[row] ? 1 : 0;
    if (!inUse[row]) return;
    const Place& place = places_[row];
    const Patch& patch = lights.patches(place.object).patches[static_cast<size_t>(place.leaf)];
    spheres_.set(row, patch.centre, patch.radius);
    ShadowMode* uses = now_.data() + row * slots_;
    ShadowMode* last = before_.data() + row * slots_;
    lights.uses(place.object, place.leaf, place.isMapped, {uses, slots_});
    if (!wasKnown) {
      std::copy_n(uses, slots_, last);
    } else if (!std::equal(uses, uses + slots_, last)) {
      for (size_t slot = 0; slot < slots_; ++slot)
        if (uses[slot] != last[slot]) changed_[row].push_back(static_cast<int>(slot));
    }
  });
}

void PlaceTable::findTouched(std::span<const Staying> lights) {
  touched_.resize(slots_);
  tbb::parallel_for(size_t{0}, lights.size(), [&](size_t i) {
    const Staying& light = lights[i];
    const auto slot = static_cast<size_t>(light.is->slot);
    std::vector<uint8_t>& touched = touched_[slot];
    spheres_.findReached(*light.is, light.change, touched);
    for (size_t row = 0; row < places_.size(); ++row) {
      const ShadowMode before = before_[row * slots_ + slot], now = now_[row * slots_ + slot];
      const bool isLit = now == ShadowMode::add && light.isReplaced();
      touched[row] = now != before || isLit || (readsShadowMap(now) && touched[row] != 0) ? 1 : 0;
    }
  });
}

void PlaceTable::accept() {
  for (std::vector<uint8_t>& touched : touched_) touched.clear();
  for (size_t row = 0; row < changed_.size(); ++row) {
    for (const int slot : changed_[row]) {
      const size_t at = row * slots_ + static_cast<size_t>(slot);
      before_[at] = now_[at];
    }
    changed_[row].clear();
  }
}

uint16_t TilePlaces::placeOf(const GBuffer& g, const PatchLights& lights, size_t i) {
  const uint32_t object = g.object[i];
  const ObjectPatches& patches = lights.patches(object);
  const int leaf = patches.leafAt(g.triangle[i], vec3(g.px[i], g.py[i], g.pz[i]));
  const int chart = patches.patches[static_cast<size_t>(leaf)].chart;
  const vec3 normal(g.gx[i], g.gy[i], g.gz[i]);
  const bool isMapped =
      lights.hasTransfer(object, leaf)
          ? lights.prt()->isFront(object, g.triangle[i], normal)
          : lights.isMapped(object, leaf) &&
                glm::dot(normal, patches.charts[static_cast<size_t>(chart)].normal) > 0.0f;
  const Place place{object, leaf, isMapped};
  // Neighbours usually lie in the place found last.
  for (size_t k = places_.size(); k-- > 0;)
    if (places_[k] == place) return static_cast<uint16_t>(k);
  places_.push_back(place);
  return static_cast<uint16_t>(places_.size() - 1);
}

void TilePlaces::clear() {
  known_ = hit_ = 0;
  places_.clear();
  rows_.clear();
  parts_.clear();
  kinds_.clear();
}

void TilePlaces::find(const GBuffer& g, int tile, const PatchLights* patches, uint32_t packets) {
  first_ = static_cast<size_t>(tile) * kTilePixels;
  std::vector<Part> parts;
  // The previous pixel and its place: a pixel on the same triangle usually has the same place.
  size_t last = 0;
  int lastPlace = kNone;
  const auto isAsLast = [&](size_t i) {
    return lastPlace != kNone && g.object[i] == g.object[last] &&
           g.triangle[i] == g.triangle[last] &&
           liesIn(patches->patches(g.object[i]), places_[static_cast<size_t>(lastPlace)].leaf,
                  {g.px[i], g.py[i], g.pz[i]});
  };
  for (packets &= ~known_; packets != 0; packets &= packets - 1) {
    const int packet = std::countr_zero(packets);
    known_ |= uint32_t{1} << packet;
    parts.clear();
    const size_t of = first_ + static_cast<size_t>(packet * kLanes);
    const bool isPlaced =
        lastPlace != kNone && showSame(g, of, last) &&
        lieIn(patches->patches(g.object[of]), places_[static_cast<size_t>(lastPlace)].leaf, g, of);
    if (isPlaced) {
      parts.push_back({static_cast<uint16_t>(lastPlace), 0xff});
      last = of + kLanes - 1;
    }
    for (int lane = isPlaced ? kLanes : 0; lane < kLanes; ++lane) {
      const size_t i = of + static_cast<size_t>(lane);
      if (g.hit[i] == 0) continue;
      if (patches != nullptr && !isAsLast(i)) lastPlace = placeOf(g, *patches, i);
      last = i;
      const auto place = static_cast<uint16_t>(std::max(lastPlace, 0));
      const auto it =
          std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.place == place; });
      Part& part = it == parts.end() ? parts.emplace_back(Part{place, 0}) : *it;
      part.lanes |= static_cast<uint8_t>(1u << lane);
    }
    if (parts.empty()) continue;
    const uint32_t bit = uint32_t{1} << packet;
    hit_ |= bit;
    const auto it = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& k) {
      return std::equal(parts.begin(), parts.end(), parts_.begin() + k.first,
                        parts_.begin() + k.first + k.count);
    });
    if (it != kinds_.end()) {
      it->packets |= bit;
      continue;
    }
    kinds_.push_back(
        {static_cast<uint32_t>(parts_.size()), static_cast<uint32_t>(parts.size()), bit});
    parts_.insert(parts_.end(), parts.begin(), parts.end());
  }
}

void TilePlaces::takeRows(PlaceTable& table) {
  rows_.clear();
  for (const Place& place : places_) rows_.push_back(table.rowOf(place));
}

}  // namespace lamplighter::cpu
