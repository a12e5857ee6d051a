#include "renderer/visibility/visibility_database.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr uint8_t kUnknown = 255;

// A patch is divided where more lights than this share of all, and than this many, are partial.
constexpr float kMostPartialShare = 0.05f;
constexpr int kMostPartial = 4;

// More objects that move at once are not told apart from the others.
constexpr size_t kMostMovers = 16;

// Roots of patch trees that are one task: a level may be one object.
constexpr size_t kRootsPerTask = 64;

// All but the slot and the brightness, which change nothing here.
bool sameLight(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

bool isLight(const shared::Vpl& vpl) { return vec3(vpl.normal) != vec3(0.0f); }

struct Share {
  uint32_t object;
  size_t firstRoot, lastRoot;
};
std::vector<Share> sharesOf(std::span<const ObjectPatches> patches) {
  std::vector<Share> shares;
  for (uint32_t i = 0; i < patches.size(); ++i) {
    const size_t roots = patches[i].roots.size();
    for (size_t first = 0; first < roots; first += kRootsPerTask)
      shares.push_back({i, first, std::min(first + kRootsPerTask, roots)});
  }
  return shares;
}

}  // namespace

// A light, and what of the scene it has to take in.
struct VisibilityDatabase::Column {
  int slot = 0;
  bool anew = true;                  // all entries
  bool moversAreAll = false;         // what it waits for are the movers of now, and no more
  std::vector<ShadowReach> reaches;  // of the movers, before and now
  std::vector<bool> isMover;         // by object: all its entries
  bool mayBeShadowed(const Patch& p) const {
    return std::any_of(reaches.begin(), reaches.end(),
                       [&](const ShadowReach& r) { return r.mayFallOn(p.centre, p.radius); });
  }
};

void VisibilityDatabase::resize(size_t slots) {
  waiting_.resize(std::max(slots, waiting_.size()));
  if (slots <= stride_) return;
  const size_t stride = std::max(slots, stride_ + stride_ / 2);
  const auto widen = [&](std::vector<uint8_t>& rows, size_t patches, uint8_t fill) {
    std::vector<uint8_t> wider(patches * stride, fill);
    for (size_t p = 0; stride_ > 0 && p < patches; ++p)
      std::copy_n(&rows[p * stride_], stride_, &wider[p * stride]);
    rows = std::move(wider);
  };
  for (size_t i = 0; i < rows_.size(); ++i) {
    const size_t patches = patches_[i].patches.size();
    widen(rows_[i], patches, static_cast<uint8_t>(Occlusion::partial));
    widen(withoutMovers_[i], patches, kUnknown);
  }
  stride_ = stride;
}

void VisibilityDatabase::forgetOthers() {
  for (auto& rows : withoutMovers_) std::fill(rows.begin(), rows.end(), kUnknown);
}

void VisibilityDatabase::addWaiting(int object, const Bounds& before) {
  for (size_t slot = 0; slot < lights_.size(); ++slot) {
    if (!isLight(lights_[slot])) continue;
    std::vector<Waiting>& list = waiting_[slot];
    const bool isKnown =
        object != kNone &&
        std::any_of(list.begin(), list.end(), [&](const Waiting& w) { return w.object == object; });
    if (!isKnown) list.push_back({object, before});
  }
}

void VisibilityDatabase::placeObject(const RenderScene& scene, uint32_t object) {
  MeshTopology& topology = topologies_[object];
  const RenderObject& o = scene.objects[object];
  if (topology.charts.empty() && topology.clusters.empty() ? o.triangleCount() > 0
                                                           : !(topology.shape == shapeOf(o)))
    topology = findTopology(scene, object);
  patches_[object] = placePatches(scene, object, topology);
  const size_t patches = patches_[object].patches.size();
  rows_[object].assign(patches * stride_, static_cast<uint8_t>(Occlusion::partial));
  withoutMovers_[object].assign(patches * stride_, kUnknown);
  divided_[object].assign(patches, 0);
  changed_[object].assign(patches, 1);
}

// Objects are numbered anew, or their materials changed: those that are the same keep all that is
// known of them, the others went and came.
void VisibilityDatabase::matchObjects(const RenderScene& scene, std::vector<Move>& moves) {
  std::vector<ObjectIdentity> now = identify(scene);
  const std::vector<int> same = findSame(identities_, now);
  std::vector<int> becomes(identities_.size(), kNone);
  for (size_t i = 0; i < same.size(); ++i)
    if (same[i] != kNone) becomes[static_cast<size_t>(same[i])] = static_cast<int>(i);

  const auto reorder = [&](auto& values) {
    std::remove_reference_t<decltype(values)> next(now.size());
    for (size_t i = 0; i < same.size(); ++i)
      if (same[i] != kNone) next[i] = std::move(values[static_cast<size_t>(same[i])]);
    values = std::move(next);
  };
  std::vector<Bounds> boundsBefore;
  for (const ObjectPatches& p : patches_) boundsBefore.push_back(p.bounds);
  for (auto& list : waiting_) {
    for (Waiting& w : list)
      if (w.object != kNone) w.object = becomes[static_cast<size_t>(w.object)];
  }
  reorder(topologies_);
  reorder(patches_);
  reorder(rows_);
  reorder(withoutMovers_);
  reorder(divided_);
  reorder(changed_);
  identities_ = std::move(now);
  cameFrom_ = same;

  occluders_.resize(scene.objects.size());
  std::vector<uint32_t> fresh;
  for (size_t old = 0; old < becomes.size(); ++old) {
    if (becomes[old] != kNone) continue;
    addWaiting(kNone, boundsBefore[old]);
    moves.push_back({boundsBefore[old], Bounds()});
  }
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (same[i] != kNone) {
      for (Chart& chart : patches_[i].charts) chart.object = i;
      continue;
    }
    fresh.push_back(i);
    addWaiting(static_cast<int>(i), Bounds());
    moves.push_back({Bounds(), scene.objects[i].bounds});
  }
  tbb::parallel_for(size_t{0}, fresh.size(), [&](size_t i) { placeObject(scene, fresh[i]); });
  tbb::parallel_for(uint32_t{0}, static_cast<uint32_t>(scene.objects.size()),
                    [&](uint32_t i) { occluders_.place(scene, i, topologies_[i], patches_[i]); });
  setMovers(fresh);
  forgetOthers();
}

void VisibilityDatabase::setMovers(std::span<const uint32_t> objects) {
  const std::vector<uint32_t> movers(
      objects.begin(), objects.end() - (objects.size() > kMostMovers ? objects.size() : 0));
  if (movers == movers_ && !movers.empty()) return;
  movers_ = movers;
  forgetOthers();
}

void VisibilityDatabase::takeMoved(const RenderScene& scene, const RenderSceneChanges& changes,
                                   std::vector<Move>& moves) {
  const std::vector<uint32_t>& moved = changes.movedObjects;
  setMovers(moved);
  for (const uint32_t i : moved) {
    moves.push_back({patches_[i].bounds, scene.objects[i].bounds});
    addWaiting(static_cast<int>(i), patches_[i].bounds);
    cameFrom_[i] = kNone;
  }
  tbb::parallel_for(size_t{0}, moved.size(), [&](size_t i) {
    placeObject(scene, moved[i]);
    occluders_.place(scene, moved[i], topologies_[moved[i]], patches_[moved[i]]);
    identities_[moved[i]] = identify(scene, moved[i]);
  });
}

void VisibilityDatabase::setScene(const RenderScene& scene, const RenderSceneChanges& changes) {
  moves_.clear();
  cameFrom_.resize(scene.objects.size());
  std::iota(cameFrom_.begin(), cameFrom_.end(), 0);
  if (changes.rebuilt || patches_.size() != scene.objects.size()) {
    matchObjects(scene, moves_);
  } else {
    if (changes.materials) matchObjects(scene, moves_);
    if (!changes.movedObjects.empty()) takeMoved(scene, changes, moves_);
  }
  if (!moves_.empty()) occluders_.finish(scene);
}

bool VisibilityDatabase::moversAreHidden(const shared::Vpl& vpl) const {
  if (moves_.size() > kMostMovers) return false;
  return std::all_of(moves_.begin(), moves_.end(), [&](const Move& m) {
    for (const Bounds& box : {m.before, m.after}) {
      if (box.empty()) continue;
      const OcclusionPyramid pyramid(vpl, PatchRegion(box));
      if (pyramid.isDark()) continue;
      if (pyramid.isDegenerate() || !occluders_.hiddenWithout(pyramid, movers_)) return false;
    }
    return true;
  });
}

void VisibilityDatabase::setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot) {
  resize(bySlot.size());
  std::vector<int> slots;
  for (size_t i = 0; i < bySlot.size(); ++i) {
    if (i < lights_.size() && sameLight(lights_[i], bySlot[i])) continue;
    waiting_[i].clear();
    slots.push_back(static_cast<int>(i));
  }
  for (size_t i = bySlot.size(); i < lights_.size(); ++i) waiting_[i].clear();
  lights_.assign(bySlot.begin(), bySlot.end());
  isLive_.resize(lights_.size());
  for (size_t i = 0; i < lights_.size(); ++i) isLive_[i] = isLight(lights_[i]) ? 1 : 0;
  if (slots.empty()) return;
  for (auto& rows : withoutMovers_) {
    for (size_t first = 0; first < rows.size(); first += stride_)
      for (const int slot : slots) rows[first + static_cast<size_t>(slot)] = kUnknown;
  }
  const uint64_t before = tests_;
  computeColumns(scene, slots, true);
  testsPerColumn_ = (tests_ - before) / slots.size();
}

void VisibilityDatabase::refreshAll(const RenderScene& scene) {
  std::vector<int> slots(lights_.size());
  std::iota(slots.begin(), slots.end(), 0);
  refresh(scene, slots);
}

void VisibilityDatabase::refresh(const RenderScene& scene, std::span<const int> slots) {
  std::vector<int> waiting;
  for (const int slot : slots)
    if (isWaiting(slot)) waiting.push_back(slot);
  if (!waiting.empty()) computeColumns(scene, waiting, false);
}

void VisibilityDatabase::computeColumns(const RenderScene& scene, std::span<const int> slots,
                                        bool anew) {
  std::vector<Column> columns;
  for (const int slot : slots) {
    const shared::Vpl& vpl = lights_[static_cast<size_t>(slot)];
    if (!isLight(vpl)) continue;
    Column& column = columns.emplace_back();
    column.slot = slot;
    column.anew = anew;
    if (anew) continue;
    column.isMover.assign(patches_.size(), false);
    column.moversAreAll = true;
    for (const Waiting& w : waiting_[static_cast<size_t>(slot)]) {
      const auto add = [&](const Bounds& box) {
        const ShadowReach reach(vpl, box);
        if (!reach.isEmpty()) column.reaches.push_back(reach);
      };
      add(w.before);
      if (w.object == kNone) continue;
      add(patches_[static_cast<size_t>(w.object)].bounds);
      column.isMover[static_cast<size_t>(w.object)] = true;
      column.moversAreAll =
          column.moversAreAll && std::find(movers_.begin(), movers_.end(),
                                           static_cast<uint32_t>(w.object)) != movers_.end();
    }
    waiting_[static_cast<size_t>(slot)].clear();
  }
  const std::vector<Share> shares = sharesOf(patches_);
  std::atomic<uint64_t> tests = 0;
  tbb::parallel_for(size_t{0}, shares.size() * columns.size(), [&](size_t item) {
    const Share& share = shares[item / columns.size()];
    const Column& column = columns[item % columns.size()];
    uint64_t mine = 0;
    for (size_t r = share.firstRoot; r < share.lastRoot; ++r)
      compute(scene, column, share.object, patches_[share.object].roots[r], false, mine);
    tests += mine;
  });
  tests_ += tests;
  divide(scene);
}

// Whether no mover makes a difference where this is the state by all others.
bool VisibilityDatabase::isDecided(Occlusion others) const {
  if (others == Occlusion::partial)
    return std::none_of(movers_.begin(), movers_.end(),
                        [&](uint32_t i) { return occluders_.mayHide(i); });
  return others == Occlusion::full;
}

Occlusion VisibilityDatabase::stateOf(const RenderScene& scene, const OcclusionPyramid& pyramid,
                                      uint32_t object, int patch, int slot, uint64_t& tests) {
  uint8_t& others = withoutMovers_[object][entry(patch, slot)];
  if (others == kUnknown) {
    if (!pyramid.isDark()) ++tests;
    others = static_cast<uint8_t>(occluders_.occlusionWithout(scene, pyramid, movers_));
  }
  if (static_cast<Occlusion>(others) == Occlusion::full) return Occlusion::full;
  return std::max(static_cast<Occlusion>(others), occluders_.occlusionBy(scene, pyramid, movers_));
}

// Table 4-1: where nothing that moved can be between, before or now, nothing is looked at. A patch
// that was or becomes none or full tells its children so.
void VisibilityDatabase::compute(const RenderScene& scene, const Column& column, uint32_t object,
                                 int patch, bool parentWasNone, uint64_t& tests) {
  const ObjectPatches& patches = patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  const shared::Vpl& vpl = lights_[static_cast<size_t>(column.slot)];
  if (!column.anew && !column.isMover[object] && !column.mayBeShadowed(p)) {
    // Dark patches are none too where all of their parent was; it no longer is.
    if (parentWasNone && OcclusionPyramid(vpl, PatchRegion(scene, object, patches, p)).isDark())
      fill(object, patch, column.slot, Occlusion::full);
    return;
  }
  const bool wasNone =
      static_cast<Occlusion>(rows_[object][entry(patch, column.slot)]) == Occlusion::none;
  uint8_t& others = withoutMovers_[object][entry(patch, column.slot)];
  Occlusion state = static_cast<Occlusion>(others);
  if (others == kUnknown || !isDecided(state)) {
    const OcclusionPyramid pyramid(vpl, PatchRegion(scene, object, patches, p));
    // Where nothing stood between, only the movers can.
    if (wasNone && column.moversAreAll && !column.isMover[object] && !pyramid.isDark())
      others = static_cast<uint8_t>(Occlusion::none);
    state = stateOf(scene, pyramid, object, patch, column.slot, tests);
  }
  if (state != Occlusion::partial || p.isLeaf() ||
      divided_[object][static_cast<size_t>(patch)] == 0) {
    fill(object, patch, column.slot, state);
    return;
  }
  set(object, patch, column.slot, state);
  compute(scene, column, object, p.firstChild, wasNone, tests);
  compute(scene, column, object, p.firstChild + 1, wasNone, tests);
}

int VisibilityDatabase::mostPartial() const {
  const auto lights = static_cast<float>(std::count_if(lights_.begin(), lights_.end(), isLight));
  return std::max(kMostPartial, static_cast<int>(kMostPartialShare * lights));
}

void VisibilityDatabase::divide(const RenderScene& scene) {
  const std::vector<Share> shares = sharesOf(patches_);
  const int most = mostPartial();
  std::atomic<uint64_t> tests = 0;
  tbb::parallel_for(size_t{0}, shares.size(), [&](size_t i) {
    uint64_t mine = 0;
    for (size_t r = shares[i].firstRoot; r < shares[i].lastRoot; ++r)
      divide(scene, shares[i].object, patches_[shares[i].object].roots[r], most, mine);
    tests += mine;
  });
  tests_ += tests;
}

void VisibilityDatabase::divide(const RenderScene& scene, uint32_t object, int patch, int most,
                                uint64_t& tests) {
  const Patch& p = patches_[object].patches[static_cast<size_t>(patch)];
  if (p.isLeaf()) return;
  uint8_t& isDivided = divided_[object][static_cast<size_t>(patch)];
  const uint8_t* states = &rows_[object][entry(patch, 0)];
  int partial = 0;
  for (size_t slot = 0; slot < isLive_.size(); ++slot)
    partial += states[slot] == static_cast<uint8_t>(Occlusion::partial) ? isLive_[slot] : 0;
  const bool divides = partial > most;
  if (divides != (isDivided != 0)) {
    isDivided = divides ? 1 : 0;
    for (size_t s = 0; s < lights_.size(); ++s) {
      if (states[s] != static_cast<uint8_t>(Occlusion::partial) || isLive_[s] == 0) continue;
      const int slot = static_cast<int>(s);
      for (int child = p.firstChild; child < p.firstChild + 2; ++child) {
        if (!divides) {
          fill(object, child, slot, Occlusion::partial);
          continue;
        }
        const Patch& c = patches_[object].patches[static_cast<size_t>(child)];
        const OcclusionPyramid pyramid(lights_[s], PatchRegion(scene, object, patches_[object], c));
        fill(object, child, slot, stateOf(scene, pyramid, object, child, slot, tests));
      }
    }
    // The children's children are as they are now, whatever was before.
    for (int child = p.firstChild; child < p.firstChild + 2; ++child)
      divided_[object][static_cast<size_t>(child)] = 0;
  }
  if (!divides) return;
  divide(scene, object, p.firstChild, most, tests);
  divide(scene, object, p.firstChild + 1, most, tests);
}

void VisibilityDatabase::set(uint32_t object, int patch, int slot, Occlusion state) {
  uint8_t& e = rows_[object][entry(patch, slot)];
  if (e == static_cast<uint8_t>(state)) return;
  e = static_cast<uint8_t>(state);
  // Several lights of a patch may be looked at at once.
  std::atomic_ref(changed_[object][static_cast<size_t>(patch)]).store(1, std::memory_order_relaxed);
}

void VisibilityDatabase::fill(uint32_t object, int patch, int slot, Occlusion state) {
  set(object, patch, slot, state);
  const Patch& p = patches_[object].patches[static_cast<size_t>(patch)];
  if (p.isLeaf()) return;
  fill(object, p.firstChild, slot, state);
  fill(object, p.firstChild + 1, slot, state);
}

void VisibilityDatabase::clearChanged() {
  for (auto& patches : changed_) std::fill(patches.begin(), patches.end(), 0);
}

VisibilityCounts VisibilityDatabase::counts() const {
  VisibilityCounts c;
  for (uint32_t i = 0; i < patches_.size(); ++i) {
    c.patches += patches_[i].patches.size();
    c.bytes += 2 * rows_[i].size();
    for (size_t p = 0; p < patches_[i].patches.size(); ++p) {
      c.divided += divided_[i][p];
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
