#include "renderer/visibility/visibility_database.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "renderer/scene/light_linking.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

// If more objects move at once, they are not treated as movers.
constexpr size_t kMostMovers = 16;

// Compares everything except the slot and the brightness, which do not affect visibility.
bool sameLight(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent &&
         a.footprint.y == b.footprint.y;
}

}  // namespace

void VisibilityDatabase::addWaiting(int object, const Caster& before, bool couldHide) {
  for (size_t slot = 0; slot < lights_.size(); ++slot) {
    if (!isLight(lights_[slot])) continue;
    std::vector<Waiting>& list = waiting_[slot];
    const auto known =
        object == kNone ? list.end() : std::find_if(list.begin(), list.end(), [&](const auto& w) {
          return w.object == object;
        });
    if (known == list.end()) {
      list.push_back({object, before, couldHide});
    } else if (knowsNow_[slot] != 0) {
      known->before.box.add(before.box);
      known->before = Caster(known->before.box);
      known->couldHide = known->couldHide || couldHide;
    }
  }
}

// Finds the topologies that are missing or of another shape. Objects that became empty keep theirs.
void VisibilityDatabase::findTopologies(const RenderScene& scene, std::span<const uint32_t> objects,
                                        bool areMoving) {
  std::vector<uint32_t> missing;
  for (const uint32_t object : objects) {
    const auto& topology = topologies_[object];
    const RenderObject& o = scene.objects[object];
    const bool isOfNone = topology && topology->charts.empty() && topology->clusters.empty();
    if (!topology || (!o.isEmpty() && (isOfNone || !(topology->shape == shapeOf(o)))))
      missing.push_back(object);
  }
  const auto found = meshes_.find(scene, missing, areMoving);
  for (size_t i = 0; i < missing.size(); ++i) topologies_[missing[i]] = found[i];
}

void VisibilityDatabase::placeObject(const RenderScene& scene, uint32_t object) {
  const bool isNew = patches_[object].bounds.empty();
  if (scene.objects[object].isEmpty()) {
    patches_[object] = ObjectPatches();
    patches_[object].revision.advance();
  } else {
    patches_[object] = placePatches(scene, object, *topologies_[object]);
  }
  const size_t patches = patches_[object].patches.size();
  rows_[object].assign(patches, Row());
  divided_[object].assign(patches, 0);
  changed_[object].assign(patches, 1);
  // Roots that had entries get new ones, if these are the same roots. ask() sees to the others. A
  // new object waits for answer(): the division of its patches is not known before their entries.
  if (isNew || given_[object].size() != patches) given_[object].assign(patches, 0);
  const bool givesAll = demand_.isForAll && !(isNew && wasAsked_);
  for (const int root : patches_[object].roots) {
    if (givesAll) given_[object][static_cast<size_t>(root)] = PatchDemand::kAllLevels;
    if (levelsGiven(object, root) > 0) giveRow(object, root);
  }
}

// Called if objects were renumbered or their materials changed. Identical objects keep their
// entries; all others count as removed and added.
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
  std::vector<Caster> castersBefore;
  for (const ObjectPatches& p : patches_) castersBefore.emplace_back(p.bounds, p.radius);
  for (auto& list : waiting_) {
    for (Waiting& w : list)
      if (w.object != kNone) w.object = becomes[static_cast<size_t>(w.object)];
  }
  // Those of removed objects may be found again, as after a change of materials.
  const auto topologiesBefore = topologies_;
  // Empty objects are equal.
  for (size_t i = 0; i < identities_.size(); ++i)
    if (identities_[i].node == kNoNode) topologies_[i] = nullptr;
  reorder(topologies_);
  reorder(patches_);
  reorder(rows_);
  reorder(divided_);
  reorder(changed_);
  reorder(given_);
  identities_ = std::move(now);
  cameFrom_ = same;

  occluders_.resize(scene.objects.size());
  std::vector<uint32_t> fresh;
  for (size_t old = 0; old < becomes.size(); ++old) {
    if (becomes[old] != kNone || castersBefore[old].box.empty()) continue;
    addWaiting(kNone, castersBefore[old], true);
    moves.push_back({castersBefore[old].box, Bounds()});
  }
  std::vector<uint32_t> movers;
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (same[i] != kNone) {
      for (Chart& chart : patches_[i].charts) chart.object = i;
      continue;
    }
    fresh.push_back(i);
    if (scene.objects[i].isEmpty()) continue;
    movers.push_back(i);
    addWaiting(static_cast<int>(i), Caster(), false);
    moves.push_back({Bounds(), scene.objects[i].bounds});
  }
  fillWithoutEntries(scene);
  std::vector<uint32_t> all(scene.objects.size());
  std::iota(all.begin(), all.end(), 0u);
  findTopologies(scene, all, false);
  tbb::parallel_for(size_t{0}, fresh.size(), [&](size_t i) { placeObject(scene, fresh[i]); });
  tbb::parallel_for(uint32_t{0}, static_cast<uint32_t>(scene.objects.size()),
                    [&](uint32_t i) { occluders_.place(scene, i, *topologies_[i], patches_[i]); });
  // If all objects are new, none are treated as movers.
  setMovers(fresh.size() < scene.objects.size() ? movers : std::vector<uint32_t>());
  forgetOthers();
}

// Adds empty objects.
void VisibilityDatabase::grow(size_t objects) {
  topologies_.resize(objects);
  identities_.resize(objects);
  patches_.resize(objects);
  rows_.resize(objects);
  divided_.resize(objects);
  changed_.resize(objects);
  given_.resize(objects);
  leftOutBy_.resize(objects);
  occluders_.resize(objects);
}

void VisibilityDatabase::setMovers(std::span<const uint32_t> objects) {
  const std::vector<uint32_t> movers(
      objects.begin(), objects.end() - (objects.size() > kMostMovers ? objects.size() : 0));
  if (movers == movers_ && !movers.empty()) return;
  movers_ = movers;
  forgetOthers();
}

// Some of them may come or go.
void VisibilityDatabase::takeMoved(const RenderScene& scene, const RenderSceneChanges& changes,
                                   std::vector<Move>& moves) {
  const std::vector<uint32_t>& moved = changes.movedObjects;
  std::vector<uint32_t> movers;
  bool anyIsOther = false;
  for (const uint32_t i : moved) {
    const bool isGone = scene.objects[i].isEmpty();
    if (!isGone) movers.push_back(i);
    anyIsOther = anyIsOther || isGone != patches_[i].bounds.empty();
  }
  setMovers(movers);
  if (anyIsOther) {
    forgetOthers();
    fillWithoutEntries(scene);
  }
  const auto placeOf = [&](uint32_t i) {
    const std::span<const Bounds> groups = occluders_.groups(i);
    return MoverPlace{occluders_.caster(i), {groups.begin(), groups.end()}};
  };
  std::vector<MoverPlace> before;
  for (const uint32_t i : movers_) before.push_back(placeOf(i));
  for (const uint32_t i : moved) {
    moves.push_back({patches_[i].bounds, scene.objects[i].bounds});
    addWaiting(static_cast<int>(i), Caster(patches_[i].bounds, patches_[i].radius),
               occluders_.mayHide(i));
    cameFrom_[i] = kNone;
  }
  findTopologies(scene, moved, true);
  tbb::parallel_for(size_t{0}, moved.size(), [&](size_t i) {
    const uint32_t object = moved[i];
    tbb::parallel_invoke([&] { identities_[object] = identify(scene, object); },
                         [&] {
                           placeObject(scene, object);
                           occluders_.place(scene, object, *topologies_[object], patches_[object]);
                         });
  });
  if (anyIsOther) return;
  std::vector<MoverPlace> now;
  for (const uint32_t i : movers_) now.push_back(placeOf(i));
  if (const MoverPath::Mark by = path_.advance(before, now); by > 0) lowerMarks(by);
}

void VisibilityDatabase::setScene(const RenderScene& scene, const RenderSceneChanges& changes) {
  moves_.clear();
  cameFrom_.resize(scene.objects.size());
  std::iota(cameFrom_.begin(), cameFrom_.end(), 0);
  if (changes.rebuilt || patches_.size() > scene.objects.size()) {
    matchObjects(scene, moves_);
  } else {
    grow(scene.objects.size());
    if (changes.materials) matchObjects(scene, moves_);
    if (!changes.movedObjects.empty()) takeMoved(scene, changes, moves_);
  }
  if (moves_.empty()) return;
  occluders_.finish(scene);
  growTree();
  limitChanged_ = takeMemoryLimit(stride_) || limitChanged_;
}

void VisibilityDatabase::growTree() {
  std::vector<Bounds> boxes;
  for (const ObjectPatches& p : patches_) boxes.push_back(p.tree.bounds());
  if (tree_.size() == boxes.size()) {
    tree_.refit(boxes);
  } else {
    tree_ = BoundsTree(boxes);
  }
}

bool VisibilityDatabase::moversAreHidden(const shared::Vpl& vpl) const {
  if (moves_.size() > kMostMovers) return false;
  return std::all_of(moves_.begin(), moves_.end(), [&](const Move& m) {
    for (const Bounds& box : {m.before, m.after}) {
      if (box.empty()) continue;
      const PatchRegion region(box);
      const OcclusionPyramid pyramid(vpl, region);
      if (pyramid.isDark()) continue;
      if (pyramid.isDegenerate() || !occluders_.hiddenWithout(pyramid, movers_)) return false;
    }
    return true;
  });
}

bool VisibilityDatabase::isHiddenFromEye(const RenderScene& scene, const shared::Vpl& eye,
                                         uint32_t object, int patch) const {
  const ObjectPatches& patches = patches_[object];
  const PatchRegion region(scene, object, patches, patches.patches[static_cast<size_t>(patch)]);
  return occluders_.hiddenFromEye(scene, OcclusionPyramid(eye, region), vec3(eye.position));
}

void VisibilityDatabase::setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot) {
  // The present division of patches may be due to lights that were removed.
  bool areGone = false;
  for (size_t i = 0; i < lights_.size(); ++i)
    areGone = areGone || (isLight(lights_[i]) && (i >= bySlot.size() || !isLight(bySlot[i])));
  limitChanged_ = takeMemoryLimit(rowBytes(bySlot.size())) || limitChanged_;
  resize(bySlot.size());
  std::vector<int> slots;
  for (size_t i = 0; i < bySlot.size(); ++i) {
    if (i < lights_.size() && sameLight(lights_[i], bySlot[i])) continue;
    waiting_[i].clear();
    knowsNow_[i] = 0;
    slots.push_back(static_cast<int>(i));
  }
  for (size_t i = bySlot.size(); i < lights_.size(); ++i) waiting_[i].clear();
  lights_.assign(bySlot.begin(), bySlot.end());
  isLive_.resize(lights_.size());
  for (size_t i = 0; i < lights_.size(); ++i) isLive_[i] = isLight(lights_[i]) ? 1 : 0;
  fillWithoutEntries(scene);
  const bool mayDivide = std::exchange(limitChanged_, false) || areGone;
  if (slots.empty() && !mayDivide) return;
  const uint64_t before = tests_;
  computeNew(scene, slots, mayDivide);
  if (!slots.empty()) testsPerColumn_ = (tests_ - before) / slots.size();
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
  if (!waiting.empty()) computeWaiting(scene, waiting);
  if (std::exchange(limitChanged_, false)) computeNew(scene, {}, true);
}

void VisibilityDatabase::clearChanged() {
  for (auto& patches : changed_) std::fill(patches.begin(), patches.end(), 0);
}

VisibilityCounts VisibilityDatabase::counts() const {
  VisibilityCounts c;
  c.bytes = bytes();
  for (uint32_t i = 0; i < patches_.size(); ++i) {
    c.patches += patches_[i].patches.size();
    for (size_t p = 0; p < patches_[i].patches.size(); ++p) {
      c.divided += divided_[i][p];
      c.rows += rows_[i][p].states.empty() ? 0 : 1;
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
