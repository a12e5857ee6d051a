#include "renderer/visibility/visibility_database.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <numeric>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr uint8_t kUnknown = 255;

// All but the slot and the brightness, which change nothing here.
bool sameLight(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

void VisibilityDatabase::resize(size_t slots) {
  if (slots <= stride_) return;
  const size_t stride = std::max(slots, stride_ + stride_ / 2);
  const auto widen = [&](std::vector<uint8_t>& rows, uint8_t fill) {
    const size_t patches = stride_ > 0 ? rows.size() / stride_ : 0;
    std::vector<uint8_t> wider(patches * stride, fill);
    for (size_t p = 0; p < patches; ++p)
      std::copy_n(&rows[p * stride_], stride_, &wider[p * stride]);
    rows = std::move(wider);
  };
  for (auto& rows : rows_) widen(rows, static_cast<uint8_t>(Occlusion::partial));
  for (auto& rows : withoutMovers_) widen(rows, kUnknown);
  stride_ = stride;
}

void VisibilityDatabase::forgetOthers() {
  for (auto& rows : withoutMovers_) std::fill(rows.begin(), rows.end(), kUnknown);
}

void VisibilityDatabase::setScene(const RenderScene& scene, const RenderSceneChanges& changes) {
  const bool all = changes.rebuilt || changes.materials || patches_.size() != scene.objects.size();
  if (!all && changes.movedObjects.empty()) return;
  std::vector<uint32_t> changed = changes.movedObjects;
  if (all) {
    patches_.assign(scene.objects.size(), {});
    rows_.assign(scene.objects.size(), {});
    withoutMovers_.assign(scene.objects.size(), {});
    changed_.assign(scene.objects.size(), {});
    changed.resize(scene.objects.size());
    std::iota(changed.begin(), changed.end(), 0u);
  }
  tbb::parallel_for(size_t{0}, changed.size(),
                    [&](size_t i) { patches_[changed[i]] = makePatches(scene, changed[i]); });
  if (all) {
    occluders_.build(scene, patches_);
  } else {
    for (const uint32_t i : changed) occluders_.rebuild(scene, i, patches_[i]);
    occluders_.finish(scene);
  }
  if (all) {
    movers_.clear();
    forgetOthers();
  } else if (changed != movers_) {
    movers_ = changed;
    forgetOthers();
  }
  for (const uint32_t i : changed) {
    rows_[i].assign(patches_[i].patches.size() * stride_, static_cast<uint8_t>(Occlusion::partial));
    withoutMovers_[i].assign(rows_[i].size(), kUnknown);
    changed_[i].assign(patches_[i].patches.size(), 1);
  }

  std::vector<int> slots;
  for (size_t i = 0; i < lights_.size(); ++i)
    if (vec3(lights_[i].normal) != vec3(0.0f)) slots.push_back(static_cast<int>(i));
  computeAll(scene, changed, slots, {});
  if (all) return;
  std::vector<Moved> moved;
  for (size_t i = 0; i < changed.size(); ++i)
    moved.push_back({changes.movedBounds[i], scene.objects[changed[i]].bounds});
  std::vector<uint32_t> others;
  for (uint32_t i = 0; i < scene.objects.size(); ++i)
    if (std::find(changed.begin(), changed.end(), i) == changed.end()) others.push_back(i);
  computeAll(scene, others, slots, moved);
}

void VisibilityDatabase::setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot) {
  resize(bySlot.size());
  std::vector<int> slots;
  for (size_t i = 0; i < bySlot.size(); ++i) {
    if (vec3(bySlot[i].normal) == vec3(0.0f)) continue;
    if (i >= lights_.size() || !sameLight(lights_[i], bySlot[i]))
      slots.push_back(static_cast<int>(i));
  }
  lights_.assign(bySlot.begin(), bySlot.end());
  for (auto& rows : withoutMovers_) {
    for (size_t first = 0; first < rows.size(); first += stride_)
      for (const int slot : slots) rows[first + static_cast<size_t>(slot)] = kUnknown;
  }
  std::vector<uint32_t> objects(rows_.size());
  std::iota(objects.begin(), objects.end(), 0u);
  computeAll(scene, objects, slots, {});
}

void VisibilityDatabase::computeAll(const RenderScene& scene, std::span<const uint32_t> objects,
                                    std::span<const int> slots, std::span<const Moved> moved) {
  if (slots.empty()) return;
  for (const uint32_t i : objects) {
    if (!rows_[i].empty()) continue;
    rows_[i].assign(patches_[i].patches.size() * stride_, static_cast<uint8_t>(Occlusion::partial));
    withoutMovers_[i].assign(rows_[i].size(), kUnknown);
  }
  // A level may be one object, and one light may be all that moved: shared out by roots and slots.
  constexpr size_t kRoots = 64;
  struct Share {
    uint32_t object;
    size_t firstRoot;
  };
  std::vector<Share> shares;
  for (const uint32_t i : objects)
    for (size_t root = 0; root < patches_[i].roots.size(); root += kRoots)
      shares.push_back({i, root});
  std::atomic<uint64_t> tests = 0;
  tbb::parallel_for(size_t{0}, shares.size() * slots.size(), [&](size_t item) {
    const Share& share = shares[item / slots.size()];
    const std::vector<int>& roots = patches_[share.object].roots;
    const size_t last = std::min(share.firstRoot + kRoots, roots.size());
    uint64_t mine = 0;
    for (size_t r = share.firstRoot; r < last; ++r)
      compute(scene, share.object, roots[r], slots[item % slots.size()], moved, mine);
    tests += mine;
  });
  tests_ += tests;
}

void VisibilityDatabase::compute(const RenderScene& scene, uint32_t object, int patch, int slot,
                                 std::span<const Moved> moved, uint64_t& tests) {
  const ObjectPatches& patches = patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  const OcclusionPyramid pyramid(lights_[static_cast<size_t>(slot)],
                                 PatchRegion(scene, object, patches, p));
  // Dark nodes are looked at again too: a parent that was none had told them that they are.
  if (!moved.empty() && !pyramid.isDark() &&
      std::none_of(moved.begin(), moved.end(), [&](const Moved& m) {
        return pyramid.mayMeet(m.before) || pyramid.mayMeet(m.after);
      })) {
    return;
  }
  uint8_t& others =
      withoutMovers_[object][static_cast<size_t>(patch) * stride_ + static_cast<size_t>(slot)];
  if (others == kUnknown) {
    if (!pyramid.isDark()) ++tests;
    others = static_cast<uint8_t>(occluders_.occlusionWithout(scene, pyramid, movers_));
  }
  const Occlusion state =
      std::max(static_cast<Occlusion>(others), occluders_.occlusionBy(scene, pyramid, movers_));
  if (state != Occlusion::partial || p.isLeaf()) {
    fill(object, patch, slot, state);
    return;
  }
  set(object, patch, slot, state);
  // A node that was none or full has told its children so.
  compute(scene, object, p.firstChild, slot, moved, tests);
  compute(scene, object, p.firstChild + 1, slot, moved, tests);
}

void VisibilityDatabase::set(uint32_t object, int patch, int slot, Occlusion state) {
  uint8_t& entry = rows_[object][static_cast<size_t>(patch) * stride_ + static_cast<size_t>(slot)];
  if (entry == static_cast<uint8_t>(state)) return;
  entry = static_cast<uint8_t>(state);
  // Several lights of a patch may be looked at at once.
  std::atomic_ref(changed_[object][static_cast<size_t>(patch)]).store(1, std::memory_order_relaxed);
}

void VisibilityDatabase::clearChanged() {
  for (auto& patches : changed_) std::fill(patches.begin(), patches.end(), 0);
}

void VisibilityDatabase::fill(uint32_t object, int patch, int slot, Occlusion state) {
  set(object, patch, slot, state);
  const Patch& p = patches_[object].patches[static_cast<size_t>(patch)];
  if (p.isLeaf()) return;
  fill(object, p.firstChild, slot, state);
  fill(object, p.firstChild + 1, slot, state);
}

VisibilityCounts VisibilityDatabase::counts() const {
  VisibilityCounts c;
  for (uint32_t i = 0; i < patches_.size(); ++i) {
    c.patches += patches_[i].patches.size();
    c.bytes += rows_[i].size();
    for (size_t p = 0; p < patches_[i].patches.size(); ++p) {
      if (!patches_[i].patches[p].isLeaf()) continue;
      for (int slot = 0; slot < static_cast<int>(lights_.size()); ++slot) {
        const Occlusion s = state(i, static_cast<int>(p), slot);
        (s == Occlusion::none ? c.none : s == Occlusion::full ? c.full : c.partial) += 1;
      }
    }
  }
  return c;
}

}  // namespace lamplighter
