#include "renderer/light_maps/light_maps.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/base/hash.h"
#include "renderer/light_maps/accumulate.h"
#include "renderer/light_maps/light_map_eligibility.h"
#include "renderer/light_maps/texel_grid.h"
#include "renderer/scene/vpl.h"
#include "renderer/visibility/potentially_visible_patches.h"

namespace lamplighter {
namespace {

// Factor by which the texel spacing grows, repeatedly, until all maps fit.
constexpr float kTexelGrowth = 1.41421356f;
// Memory: per texel, and per tile for 64 slots.
constexpr uint64_t kTexelBytes = sizeof(vec4) + 3 * sizeof(double);
constexpr uint64_t kWordBytes = 2 * sizeof(uint64_t);

size_t wordsOf(size_t slots) { return (slots + 63) / 64; }

// Compares everything that affects a contribution.
bool sameContribution(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent &&
         a.intensity == b.intensity;
}

size_t paddedCount(const LightMapTile& tile) {
  return TexelGrid::paddedCount(tile.columns, tile.rows);
}

// For the 64 slots from 64·w: one bit for each slot whose light does not reach the patch.
uint64_t fullOnes(std::span<const uint8_t> states, size_t w) {
  uint64_t bits = 0;
  for (size_t i = 64 * w; i < std::min(64 * w + 64, states.size()); ++i)
    bits |= uint64_t{static_cast<Occlusion>(states[i]) == Occlusion::full} << i % 64;
  return bits;
}

float spacingOf(const LightMapTile& tile, const Patch& patch) {
  const vec2 size = patch.max - patch.min;
  return std::max(size.x / static_cast<float>(tile.columns - 1),
                  size.y / static_cast<float>(tile.rows - 1));
}

}  // namespace

LightMaps::Size LightMaps::sizeOf(const Object& object, const ObjectPatches& patches, float texel) {
  const LightMapTiles tiles = findTiles(patches, object.isFlat, object.levels, texel);
  return {tiles.tiles.size(), tiles.texels};
}

// The spacing for the whole scene. It depends on the number of slots only, not on earlier maps.
float LightMaps::fittingTexel(const VisibilityDatabase& visibility, size_t words) const {
  const auto fits = [&](const Size& size) {
    return size.texels <= options_.mostTexels &&
           size.texels * kTexelBytes + size.tiles * words * kWordBytes <= options_.mostBytes;
  };
  Size size;
  for (const Object& o : objects_) {
    size.tiles += o.wanted.tiles;
    size.texels += o.wanted.texels;
  }
  float texel = options_.texel;
  while (!fits(size)) {
    if (size.texels == size.tiles * TexelGrid::paddedCount(2, 2)) return 0.0f;
    texel *= kTexelGrowth;
    size = {};
    for (uint32_t i = 0; i < objects_.size(); ++i) {
      const Size some = sizeOf(objects_[i], visibility.patches(i), texel);
      size.tiles += some.tiles;
      size.texels += some.texels;
    }
  }
  return texel;
}

// Tiles that stay keep their texels; the others are left out until they are computed.
void LightMaps::makeTiles(Object& object, const ObjectPatches& patches) const {
  Object before = std::move(object);
  object.levels = before.levels;
  object.isFlat = before.isFlat;
  object.wanted = before.wanted;
  object.revision = before.revision;
  object.tiles = findTiles(patches, object.isFlat, object.levels, texel_);
  const size_t tiles = object.tiles.tiles.size();
  object.sums.assign(size_t{3} * object.tiles.texels, 0.0);
  object.irradiance.assign(object.tiles.texels, vec4(0.0f));
  object.held.assign(tiles * words_, 0);
  object.refused.assign(tiles * words_, 0);
  object.isLeftOut.assign(tiles, 1);
  object.writes.assign(tiles, 0);
  object.tiling.advance();
  if (before.tiles.ofPatch.size() != object.tiles.ofPatch.size()) return;
  for (size_t t = 0; t < tiles; ++t) {
    const LightMapTile& tile = object.tiles.tiles[t];
    const int index = before.tiles.ofPatch[static_cast<size_t>(tile.patch)];
    if (index == kNone) continue;
    const auto from = static_cast<size_t>(index);
    const LightMapTile& old = before.tiles.tiles[from];
    if (old.columns != tile.columns || old.rows != tile.rows) continue;
    const size_t count = paddedCount(tile);
    std::copy_n(&before.sums[size_t{3} * old.first], 3 * count,
                &object.sums[size_t{3} * tile.first]);
    std::copy_n(&before.irradiance[old.first], count, &object.irradiance[tile.first]);
    std::copy_n(before.held.begin() + static_cast<ptrdiff_t>(from * words_), words_,
                object.held.begin() + static_cast<ptrdiff_t>(t * words_));
    std::copy_n(before.refused.begin() + static_cast<ptrdiff_t>(from * words_), words_,
                object.refused.begin() + static_cast<ptrdiff_t>(t * words_));
    object.isLeftOut[t] = before.isLeftOut[from];
  }
}

void LightMaps::resize(size_t slots) {
  const size_t words = wordsOf(slots);
  if (words == words_) return;
  const size_t kept = std::min(words, words_);
  for (Object& o : objects_) {
    for (std::vector<uint64_t>* bits : {&o.held, &o.refused}) {
      std::vector<uint64_t> other(o.tiles.tiles.size() * words, 0);
      for (size_t t = 0; kept > 0 && t < o.tiles.tiles.size(); ++t)
        std::copy_n(&(*bits)[t * words_], kept, &other[t * words]);
      *bits = std::move(other);
    }
  }
  words_ = words;
}

void LightMaps::update(const RenderScene& scene, const VisibilityDatabase& visibility,
                       std::span<const shared::Vpl> given, const Options& options, const View* view,
                       bool mayBeFiner) {
  // Slots beyond the given ones are empty.
  std::vector<shared::Vpl> bySlot(given.begin(), given.end());
  bySlot.resize(std::max(bySlot.size(), lights_.size()));
  if (!(options == options_)) objects_.clear();
  options_ = options;
  std::vector<Object> objects(scene.objects.size());
  // Objects without tiles, and objects of which other patches have entries now.
  std::vector<uint32_t> fresh, outdated;
  for (uint32_t i = 0; i < objects.size(); ++i) {
    const int from = visibility.cameFrom()[i];
    if (from != kNone && static_cast<size_t>(from) < objects_.size()) {
      objects[i] = std::move(objects_[static_cast<size_t>(from)]);
    } else {
      fresh.push_back(i);
    }
    if (!std::ranges::equal(objects[i].levels, visibility.levels(i))) outdated.push_back(i);
  }
  const bool mayFitOtherwise = !fresh.empty() || !outdated.empty() ||
                               objects.size() != objects_.size() ||
                               wordsOf(given.size()) != fittingWords_;
  objects_ = std::move(objects);
  resize(bySlot.size());
  tbb::parallel_for(size_t{0}, outdated.size(), [&](size_t i) {
    const ObjectPatches& patches = visibility.patches(outdated[i]);
    const std::span<const uint8_t> levels = visibility.levels(outdated[i]);
    Object& o = objects_[outdated[i]];
    o.levels.assign(levels.begin(), levels.end());
    o.isFlat.find(scene, patches, levels);
    o.wanted = sizeOf(o, patches, options.texel);
  });
  fittingWords_ = wordsOf(given.size());
  if (mayFitOtherwise) fitting_ = fittingTexel(visibility, fittingWords_);
  const bool isFiner = fitting_ > 0.0f && (texel_ == 0.0f || fitting_ < texel_);
  if (fitting_ != texel_ && (!isFiner || mayBeFiner || fresh.size() == objects_.size())) {
    texel_ = fitting_;
    outdated.resize(objects_.size());
    std::iota(outdated.begin(), outdated.end(), 0u);
  }
  // Everything that shows a new object is updated in any case.
  const bool isRetiled = std::any_of(outdated.begin(), outdated.end(), [&](uint32_t i) {
    return !std::binary_search(fresh.begin(), fresh.end(), i);
  });
  if (isRetiled) coverage_.advance();
  tbb::parallel_for(size_t{0}, outdated.size(), [&](size_t i) {
    makeTiles(objects_[outdated[i]], visibility.patches(outdated[i]));
  });

  lights_.resize(bySlot.size());
  // Slots whose lights changed, and slots with lights.
  std::vector<uint64_t> isNew(words_, 0), isThere(words_, 0);
  std::vector<uint32_t> newLights;
  for (size_t i = 0; i < bySlot.size(); ++i) {
    const uint64_t bit = uint64_t{1} << i % 64;
    if (!sameContribution(lights_[i], bySlot[i])) isNew[i / 64] |= bit;
    if (isLight(bySlot[i])) isThere[i / 64] |= bit;
    if ((isNew[i / 64] & isThere[i / 64] & bit) != 0) newLights.push_back(static_cast<uint32_t>(i));
  }
  const bool anyIsNew =
      std::any_of(isNew.begin(), isNew.end(), [](uint64_t word) { return word != 0; });

  struct Job {
    uint32_t object, tile;
  };
  std::vector<Job> jobs;
  std::optional<PotentiallyVisiblePatches> seen;
  if (view != nullptr) seen.emplace(*view);
  for (uint32_t object = 0; object < objects_.size(); ++object) {
    Object& o = objects_[object];
    const ObjectPatches& patches = visibility.patches(object);
    for (uint32_t t = 0; t < o.tiles.tiles.size(); ++t) {
      const Patch& patch = patches.patches[static_cast<size_t>(o.tiles.tiles[t].patch)];
      const bool isOutdated =
          anyIsNew || visibility.rowChanged(object, o.tiles.tiles[t].patch) || o.isLeftOut[t] != 0;
      if (!isOutdated) continue;
      if (seen && !seen->mayShowFront(patches.charts[static_cast<size_t>(patch.chart)], patch))
        o.isLeftOut[t] = 1;
      else
        jobs.push_back({object, t});
    }
  }
  std::vector<SummedLight> taken, added;  // by slot
  if (!jobs.empty()) {
    for (const shared::Vpl& vpl : lights_) taken.emplace_back(vpl, -1.0f);
    for (const shared::Vpl& vpl : bySlot) added.emplace_back(vpl, 1.0f);
  }
  const EligibleLights newOnes(bySlot, newLights, options.clampDistance);
  std::atomic<uint64_t> written = 0;
  std::vector<uint8_t> wrote(jobs.size(), 0);
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t j) {
    const Job& job = jobs[j];
    Object& o = objects_[job.object];
    const LightMapTile& tile = o.tiles.tiles[job.tile];
    const ObjectPatches& patches = visibility.patches(job.object);
    const Patch& patch = patches.patches[static_cast<size_t>(tile.patch)];
    const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
    const auto states = visibility.row(job.object, tile.patch);  // of the given lights
    const TilePlace place(chart, patch, spacingOf(tile, patch));
    const size_t count = paddedCount(tile);
    double* sums = &o.sums[size_t{3} * tile.first];
    const bool isAnew = std::exchange(o.isLeftOut[job.tile], uint8_t{0}) != 0;
    if (isAnew) {
      std::fill_n(sums, 3 * count, 0.0);
      for (std::vector<uint64_t>* bits : {&o.held, &o.refused})
        std::fill_n(bits->begin() + static_cast<ptrdiff_t>(job.tile * words_), words_, 0);
    }
    std::vector<const SummedLight*> changes;
    std::vector<uint64_t> newMappable(words_, 0);
    newOnes.find(place, newMappable);
    for (size_t w = 0; w < words_; ++w) {
      uint64_t& held = o.held[job.tile * words_ + w];
      uint64_t& refused = o.refused[job.tile * words_ + w];
      refused &= ~isNew[w];
      const uint64_t isFull = fullOnes(states, w);
      // A light that did not change and is held remains eligible; a refused one remains refused.
      uint64_t asked = isNew[w] | (held & isFull) | (isThere[w] & ~(held | isFull | refused));
      for (; asked != 0; asked &= asked - 1) {
        const uint64_t bit = asked & -asked;
        const size_t slot = 64 * w + static_cast<size_t>(std::countr_zero(asked));
        const bool has = (held & bit) != 0, isOther = (isNew[w] & bit) != 0;
        const bool mayWant = (isThere[w] & ~isFull & bit) != 0;
        const bool wants = mayWant && (isOther ? (newMappable[w] & bit) != 0
                                               : has || isLightMapEligible(bySlot[slot], place,
                                                                           options.clampDistance));
        if (mayWant && !wants) refused |= bit;
        if (has && (!wants || isOther)) changes.push_back(&taken[slot]);
        if (wants && (!has || isOther)) changes.push_back(&added[slot]);
        held = wants ? held | bit : held & ~bit;
      }
    }
    if (changes.empty() && !isAnew) return;
    const TexelGrid texels(chart, patch, tile.columns, tile.rows);
    accumulate(changes, texels.places(), options.clampDistance, sums, sums + count,
               sums + 2 * count);
    written += changes.size() * count;
    wrote[j] = 1;
    ++o.writes[job.tile];
    readSums(sums, sums + count, sums + 2 * count, {&o.irradiance[tile.first], count});
  });
  written_ += written;
  std::vector<uint32_t> changedObjects;
  for (size_t j = 0; j < jobs.size(); ++j)
    if (wrote[j] != 0 && (changedObjects.empty() || changedObjects.back() != jobs[j].object))
      changedObjects.push_back(jobs[j].object);
  changedObjects.insert(changedObjects.end(), outdated.begin(), outdated.end());
  for (const uint32_t i : changedObjects) objects_[i].revision.advance();
  lights_.assign(given.begin(), given.end());
}

size_t LightMaps::texels() const {
  size_t n = 0;
  for (const Object& o : objects_) n += o.irradiance.size();
  return n;
}

uint64_t LightMaps::bytes() const {
  uint64_t n = 0;
  for (const Object& o : objects_)
    n += o.irradiance.size() * kTexelBytes + o.held.size() * kWordBytes;
  return n;
}

uint64_t LightMaps::hash() const {
  uint64_t hash = kHashStart;
  for (const Object& o : objects_)
    for (const double sum : o.sums) hash = hashedWith(hash, std::bit_cast<uint64_t>(sum));
  return hash;
}

}  // namespace lamplighter
