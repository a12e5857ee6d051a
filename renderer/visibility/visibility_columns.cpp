// Selects what to compute when columns of the visibility database are updated: all patches for a
// new light; for a waiting light, only the patches that a shadow may reach.
#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/scene/vpl.h"
#include "renderer/visibility/jobs.h"
#include "renderer/visibility/visibility_update.h"

namespace lamplighter {
namespace {

// A patch is divided if the number of lights that are partial on it exceeds both this share of all
// lights and the constant below.
constexpr float kMostPartialShare = 0.05f;
constexpr int kMostPartial = 4;

// Smallest job of a thread: rooms have few roots, but large ones.
constexpr size_t kRootsAPiece = 2;

constexpr size_t kColumnsAPiece = 64;

// Objects with at most this many roots test them one by one, distributed over threads; other
// objects test their tree first.
constexpr size_t kFewRoots = 16;

// The old and new positions of an object are tested as one if their common bounding sphere is at
// most this many times as large as its own.
constexpr float kOneReach = 1.3f;

}  // namespace

int VisibilityDatabase::mostPartial() const {
  const auto lights = static_cast<float>(std::count_if(lights_.begin(), lights_.end(), isLight));
  return std::max(kMostPartial, static_cast<int>(kMostPartialShare * lights));
}

// Computes all columns of new lights.
void VisibilityDatabase::computeNew(const RenderScene& scene, std::span<const int> slots,
                                    bool mayDivide) {
  const int most = mostPartial();
  const bool allMayDivide = mayDivide || most != most_;
  most_ = most;
  std::vector<Task> tasks;
  std::vector<bool> isNew(lights_.size(), false);
  for (const int slot : slots) isNew[static_cast<size_t>(slot)] = true;
  clusters_ = clusterLights(lights_);
  for (const int slot : clusters_.order) {
    if (!isNew[static_cast<size_t>(slot)] || !isLight(lights_[static_cast<size_t>(slot)])) continue;
    Task& task = tasks.emplace_back();
    task.slot = slot;
    task.isNew = true;
  }
  if (tasks.empty() && !allMayDivide) return;
  std::vector<std::pair<uint32_t, int>> roots;
  for (uint32_t object = 0; object < patches_.size(); ++object)
    for (const int root : patches_[object].roots)
      if (levelsGiven(object, root) > 0) roots.emplace_back(object, root);
  std::atomic<uint64_t> tests = 0;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, roots.size(), kRootsAPiece),
                    [&](const tbb::blocked_range<size_t>& range) {
                      Update update(*this, scene, allMayDivide, clusters_.order, tests);
                      for (size_t i = range.begin(); i < range.end(); ++i)
                        update.run(roots[i].first, roots[i].second, tasks, {});
                    });
  tests_ += tests;
}

VisibilityDatabase::Column VisibilityDatabase::takeWaiting(int slot) {
  const auto i = static_cast<size_t>(slot);
  const shared::Vpl& vpl = lights_[i];
  Column column;
  column.slot = slot;
  const auto add = [&](const Caster& caster) {
    const ShadowVolume reach(vpl, caster);
    if (!reach.isEmpty())
      (column.reach.isEmpty() ? column.reach : column.more.emplace_back()) = reach;
  };
  for (const Waiting& w : waiting_[i]) {
    column.moversHidNothing = column.moversHidNothing && !w.couldHide;
    if (w.object == kNone || patches_[static_cast<size_t>(w.object)].bounds.empty()) {
      add(w.before);
      continue;
    }
    const auto object = static_cast<uint32_t>(w.object);
    const Caster now(patches_[object].bounds, patches_[object].radius);
    const Caster both(w.before, now);
    if (w.before.box.empty() || both.radius < kOneReach * now.radius) {
      add(both);
    } else {
      add(w.before);
      add(now);
    }
    column.objects.push_back(w.object);
    column.moversAreAll =
        column.moversAreAll && std::find(movers_.begin(), movers_.end(), object) != movers_.end();
  }
  waiting_[i].clear();
  knowsNow_[i] = 0;
  return column;
}

// Skips whole objects on which no shadow of a moved object may fall, then skips roots.
void VisibilityDatabase::computeWaiting(const RenderScene& scene, std::span<const int> slots) {
  std::vector<int> taken;
  for (const int slot : slots)
    if (isLight(lights_[static_cast<size_t>(slot)])) taken.push_back(slot);
  std::sort(taken.begin(), taken.end());
  taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
  std::vector<Column> columns(taken.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, taken.size(), kColumnsAPiece),
                    [&](const tbb::blocked_range<size_t>& range) {
                      for (size_t i = range.begin(); i < range.end(); ++i)
                        columns[i] = takeWaiting(taken[i]);
                    });
  SimpleColumns simple{MoverShadows(occluders_, movers_, lights_, path_),
                       ShadowVolumes(lights_.size()),
                       std::vector<const Column*>(lights_.size(), nullptr)};
  for (const Column& c : columns) {
    const auto slot = static_cast<size_t>(c.slot);
    if (!c.moversAreAll || !c.more.empty() || !simple.shadows.isAbout(slot)) continue;
    simple.bySlot[slot] = &c;
    simple.reaches.set(slot, c.reach);
  }

  // For objects that a column waits for, all entries are computed.
  std::vector<bool> isWaitedFor(patches_.size(), false);
  for (const Column& c : columns)
    for (const int object : c.objects) isWaitedFor[static_cast<size_t>(object)] = true;

  // The columns that reach each tree node: a subset of those of its parent. Simple columns are bits
  // by slot.
  const size_t words = (lights_.size() + 63) / 64;
  std::vector<uint32_t> reaching;
  std::vector<size_t> begins(1, 0);
  std::vector<uint64_t> reachingSimple(words, 0);
  for (uint32_t c = 0; c < columns.size(); ++c) {
    const auto slot = static_cast<size_t>(columns[c].slot);
    if (simple.bySlot[slot] != nullptr) {
      reachingSimple[slot / 64] |= uint64_t{1} << slot % 64;
    } else {
      reaching.push_back(c);
    }
  }
  const auto narrow = [&](const vec3& centre, float radius) {
    const size_t first = begins.back(), last = reaching.size();
    begins.push_back(last);
    for (size_t i = first; i < last; ++i)
      if (columns[reaching[i]].mayFallOn(centre, radius)) reaching.push_back(reaching[i]);
    bool any = reaching.size() > last;
    for (size_t w = 0; w < words; ++w) {
      const uint64_t before = reachingSimple[reachingSimple.size() - words];
      reachingSimple.push_back(simple.reaches.mayFallOn(w, before, centre, radius));
      any = any || reachingSimple.back() != 0;
    }
    return any;
  };
  const auto narrowToBox = [&](const Bounds& b) { return narrow(b.centre(), b.radius()); };
  const auto widen = [&] {
    reaching.resize(begins.back());
    begins.pop_back();
    reachingSimple.resize(reachingSimple.size() - words);
  };
  struct Job {
    uint32_t object;
    int root;
    std::vector<Task> tasks;
    std::vector<uint64_t> simple;  // one bit per slot
    float size = 0.0f;             // estimate of the amount of work
    void add(const Column& column, bool isOfMover) {
      Task& task = tasks.emplace_back();
      task.column = &column;
      task.slot = column.slot;
      task.work = Work::check;
      task.isOfMover = isOfMover;
    }
  };
  std::vector<Job> jobs;
  const auto addJob = [&](uint32_t object, int root) {
    if (levelsGiven(object, root) == 0) return;
    const Patch& p = patches_[object].patches[static_cast<size_t>(root)];
    Job& job = jobs.emplace_back(Job{object, root, {}, {}});
    job.simple.assign(reachingSimple.end() - static_cast<ptrdiff_t>(words), reachingSimple.end());
    for (size_t i = begins.back(); i < reaching.size(); ++i)
      if (columns[reaching[i]].mayFallOn(p.centre, p.radius)) job.add(columns[reaching[i]], false);
  };
  tree_.descend(
      narrowToBox,
      [&](uint32_t object) {
        if (isWaitedFor[object]) return;
        const std::vector<int>& roots = patches_[object].roots;
        if (roots.size() <= kFewRoots) {
          for (const int root : roots) addJob(object, root);
        } else {
          patches_[object].tree.descend(
              narrowToBox, [&](uint32_t r) { addJob(object, roots[r]); }, widen);
        }
      },
      widen);
  for (uint32_t object = 0; object < patches_.size(); ++object) {
    if (!isWaitedFor[object]) continue;
    for (const int root : patches_[object].roots) {
      if (levelsGiven(object, root) == 0) continue;
      const Patch& p = patches_[object].patches[static_cast<size_t>(root)];
      Job& job = jobs.emplace_back(Job{object, root, {}, {}});
      for (const Column& c : columns) {
        const bool isOfMover = std::find(c.objects.begin(), c.objects.end(),
                                         static_cast<int>(object)) != c.objects.end();
        if (isOfMover || c.mayFallOn(p.centre, p.radius)) job.add(c, isOfMover);
      }
    }
  }
  std::vector<int> order(lights_.size());
  std::iota(order.begin(), order.end(), 0);
  // Large patches are divided more often, and more columns mean more entries to test.
  for (Job& job : jobs) {
    size_t reached = job.tasks.size();
    for (const uint64_t word : job.simple) reached += static_cast<size_t>(std::popcount(word));
    const float radius = patches_[job.object].patches[static_cast<size_t>(job.root)].radius;
    job.size = static_cast<float>(reached) * radius * radius;
  }
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job& a, const Job& b) { return a.size > b.size; });
  std::atomic<uint64_t> tests = 0;
  doInTurn(jobs.size(), [&] {
    return [&, update = Update(*this, scene, false, order, tests)](size_t i) mutable {
      const Job& job = jobs[i];
      update.useSimple(simple);
      update.run(job.object, job.root, job.tasks, job.simple);
    };
  });
  tests_ += tests;
}

}  // namespace lamplighter
