// Which columns of the visibility database are to be brought up to date, and where: all patches for
// a light that is new, and those that a shadow may reach for one that waits.
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

// A patch is divided where more lights than this share of all, and than this many, are partial.
constexpr float kMostPartialShare = 0.05f;
constexpr int kMostPartial = 4;

// Of work for a thread, at least: rooms have few, but large ones.
constexpr size_t kRootsAPiece = 2;

constexpr size_t kColumnsAPiece = 64;

// Objects of no more roots than this have them looked at one by one, by whichever thread; those of
// more by their tree first.
constexpr size_t kFewRoots = 16;

// Where an object is and was before are looked at as one if the sphere around both is no larger
// than this times its own.
constexpr float kOneReach = 1.3f;

}  // namespace

int VisibilityDatabase::mostPartial() const {
  const auto lights = static_cast<float>(std::count_if(lights_.begin(), lights_.end(), isLight));
  return std::max(kMostPartial, static_cast<int>(kMostPartialShare * lights));
}

// All columns of lights that are new.
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
    for (const int root : patches_[object].roots) roots.emplace_back(object, root);
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
    if (w.object == kNone) {
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

// Whole objects are left out where no shadow of what moved may fall on them, and then their roots.
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

  // Of objects that a column waits for all entries are looked at.
  std::vector<bool> isWaitedFor(patches_.size(), false);
  for (const Column& c : columns)
    for (const int object : c.objects) isWaitedFor[static_cast<size_t>(object)] = true;

  // Columns that reach what the trees come to: those of a node follow those of its parent. Simple
  // ones are bits by slot.
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
    std::vector<uint64_t> simple;  // by slot, a bit each
    float size = 0.0f;             // about how much there is to do
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
  // Large patches are divided more, and more is to be looked at where more columns reach.
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
