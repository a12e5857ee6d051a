// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

// Columns of the visibility database brought up to date: patch by patch from the roots, at each for
// all lights at once, so that it is known there whether the patch is divided before its children
// are looked at.
#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include <hwy/highway.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/scene/light_linking.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// A patch is divided where more lights than this share of all, and than this many, are partial.
constexpr float kMostPartialShare = 0.05f;
constexpr int kMostPartial = 4;

// Roots, and lights at a patch, that are one piece of work for a thread.
constexpr size_t kRootsAPiece = 64;
constexpr size_t kLightsAPiece = 32;
constexpr size_t kLightsAShaft = 4;    // fewer are looked at alone
constexpr size_t kLightsToShare = 96;  // fewer are not shared out

// Where an object is and was before are looked at as one if the sphere around both is no larger
// than this times its own.
constexpr float kOneReach = 1.3f;

bool isLight(const shared::Vpl& vpl) { return vec3(vpl.normal) != vec3(0.0f); }

// Entries that are partial, of lights that are live (1, else 0).
int countPartial(std::span<const uint8_t> states, std::span<const uint8_t> isLive) {
  const hn::FixedTag<uint8_t, 32> tag;
  const auto partial = hn::Set(tag, static_cast<uint8_t>(Occlusion::partial));
  size_t count = 0, i = 0;
  for (; i + 32 <= states.size(); i += 32)
    count += hn::CountTrue(tag, hn::And(hn::Eq(hn::LoadU(tag, &states[i]), partial),
                                        hn::Ne(hn::LoadU(tag, &isLive[i]), hn::Zero(tag))));
  for (; i < states.size(); ++i)
    count += isLive[i] != 0 && states[i] == static_cast<uint8_t>(Occlusion::partial);
  return static_cast<int>(count);
}

// What is to be done for a light at a patch.
enum class Work : uint8_t {
  inherit,  // it is as it is at the parent
  check,    // it is as it was, but for what moved
  anew
};

}  // namespace

struct VisibilityDatabase::Column {
  int slot = 0;
  bool moversAreAll = true;      // what it waits for are the movers of now, and no more
  bool moversHidNothing = true;  // nor could what it waits for hide a patch alone
  // Of what it waits for, before and now; most wait for one thing.
  ShadowReach reach;
  std::vector<ShadowReach> more;
  std::vector<int> objects;  // that it waits for: all their entries
  bool mayFallOn(const vec3& centre, float radius) const {
    return reach.mayFallOn(centre, radius) ||
           std::any_of(more.begin(), more.end(),
                       [&](const ShadowReach& r) { return r.mayFallOn(centre, radius); });
  }
};

struct VisibilityDatabase::Task {
  const Column* column = nullptr;  // null: that of a light of which nothing moved
  int slot = 0;
  Work work = Work::anew;
  bool isNew = false;
  bool isOfMover = false;  // the column waits for the object
  // The entry before was not found by its own pyramid, which is not quite in that of the parent.
  bool parentWasNone = false;
  bool isSieved = false;                 // nothing that moved can be between: it stays
  Occlusion was = Occlusion::partial;    // the entry before
  Occlusion state = Occlusion::partial;  // inherit: the parent's; afterwards the entry
  Blocker met, metMover;                 // at the parent, then here
};

class VisibilityDatabase::Update {
 public:
  // allMayDivide: patches may be divided otherwise than they are though nothing changed on them.
  // `order`: all slots.
  Update(VisibilityDatabase& database, const RenderScene& scene, bool allMayDivide,
         std::span<const int> order, std::atomic<uint64_t>& tests)
      : db_(database), scene_(scene), allMayDivide_(allMayDivide), order_(order), tests_(tests) {
    for (const uint32_t mover : database.movers_)
      moversMayHide_ = moversMayHide_ || database.occluders_.mayHide(mover);
  }

  // The root and all below it; tasks in the order of slots.
  void run(uint32_t object, int root, std::span<const Task> tasks) {
    tasks_.assign(tasks.begin(), tasks.end());
    visit(object, root, 0, 0);
  }

 private:
  void visit(uint32_t object, int patch, size_t level, size_t first);
  void beginParts(uint32_t object, int patch, std::span<const Task> tasks, bool changedBefore);
  void forgetParts(uint32_t object, int patch);
  bool compute(uint32_t object, int patch, std::span<Task> tasks) const;
  // What may stand between the lights of a cluster and a patch, looked for when first wanted.
  struct Shaft {
    int cluster = -1;
    size_t first = 0, last = 0;  // of its tasks
    LightShaft shaft{{}, PatchRegion(Bounds())};
    Occluders::Candidates candidates;
  };
  // A task among others at the same patch.
  struct Place {
    std::span<const Task> tasks;
    size_t index;
    Shaft& shaft;
  };
  const Occluders::Candidates* candidatesOf(const Place& place, const PatchRegion& region) const;
  Occlusion check(const Patch& patch, const PatchRegion& region, const Task& task,
                  const Place& place, bool& isSieved, uint8_t& others, Blocker& met,
                  Blocker& metMover, uint64_t& tests) const;
  // Whether no mover makes a difference where this is the state by all others.
  bool isDecided(uint8_t others) const {
    return others == static_cast<uint8_t>(Occlusion::full) ||
           (others == static_cast<uint8_t>(Occlusion::partial) && !moversMayHide_);
  }
  void passDown(uint32_t object, int patch, int child, bool wasDivided, size_t first, size_t last);

  VisibilityDatabase& db_;
  const RenderScene& scene_;
  const bool allMayDivide_;
  const std::span<const int> order_;
  bool moversMayHide_ = false;
  std::atomic<uint64_t>& tests_;
  std::vector<Task> tasks_;  // those of the patch that is visited are the last
};

// One that is looked at, and all below it that are.
void VisibilityDatabase::Update::visit(uint32_t object, int patch, size_t level, size_t first) {
  const auto index = static_cast<size_t>(patch);
  const size_t last = tasks_.size();
  const bool changedBefore = db_.changed_[object][index] != 0;
  if (compute(object, patch, std::span(tasks_).subspan(first))) db_.changed_[object][index] = 1;
  const Patch& p = db_.patches_[object].patches[index];
  if (p.isLeaf()) return;
  const bool was = db_.isDivided(object, patch);
  const bool is =
      level + 1 < db_.levels_ && countPartial(db_.row(object, patch), db_.isLive_) > db_.most_;
  if (was && !is) forgetParts(object, patch);
  if (!is) return;
  if (!was) beginParts(object, patch, std::span(tasks_).subspan(first), changedBefore);
  for (int child = p.firstChild; child < p.firstChild + 2; ++child) {
    passDown(object, patch, child, was, first, last);
    if (tasks_.size() > last || !was || allMayDivide_) visit(object, child, level + 1, last);
    tasks_.resize(last);
  }
}

// They have been as the patch was before its tasks, which are done.
void VisibilityDatabase::Update::beginParts(uint32_t object, int patch, std::span<const Task> tasks,
                                            bool changedBefore) {
  db_.divided_[object][static_cast<size_t>(patch)] = 1;
  std::vector<Row>& rows = db_.rows_[object];
  std::vector<uint8_t> before = rows[static_cast<size_t>(patch)].states;
  for (const Task& t : tasks) before[static_cast<size_t>(t.slot)] = static_cast<uint8_t>(t.was);
  const auto first =
      static_cast<size_t>(db_.patches_[object].patches[static_cast<size_t>(patch)].firstChild);
  for (const size_t child : {first, first + 1}) {
    rows[child].states = before;
    db_.changed_[object][child] = changedBefore ? 1 : 0;
  }
}

// From now on they are as the patch is.
void VisibilityDatabase::Update::forgetParts(uint32_t object, int patch) {
  if (!db_.isDivided(object, patch)) return;
  const auto index = static_cast<size_t>(patch);
  db_.divided_[object][index] = 0;
  db_.changed_[object][index] = 1;
  const int first = db_.patches_[object].patches[index].firstChild;
  for (int child = first; child < first + 2; ++child) {
    forgetParts(object, child);
    db_.rows_[object][static_cast<size_t>(child)] = Row();
  }
}

// All tasks at one patch; whether an entry changed.
bool VisibilityDatabase::Update::compute(uint32_t object, int patch, std::span<Task> tasks) const {
  if (tasks.empty()) return false;
  const ObjectPatches& patches = db_.patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  Row& row = db_.rows_[object][static_cast<size_t>(patch)];
  // Where nothing moves it is the state itself.
  const bool keepsOthers = db_.keepsOthers_ && !db_.movers_.empty();
  if (keepsOthers && row.withoutMovers.empty()) row.withoutMovers.assign(db_.stride_, kUnknown);
  uint8_t* states = row.states.data();
  uint8_t* allOthers = keepsOthers ? row.withoutMovers.data() : nullptr;
  const bool isInherited = std::all_of(tasks.begin(), tasks.end(),
                                       [](const Task& t) { return t.work == Work::inherit; });
  const PatchRegion region =
      isInherited ? PatchRegion(Bounds()) : PatchRegion(scene_, object, patches, p);
  const uint32_t leftOutBy = scene_.objects[object].leftOutBy;
  const auto computeSome = [&](size_t first, size_t last) {
    Blocker met, metMover;  // by the light before
    uint64_t tests = 0;
    bool changed = false;
    Shaft shaft;
    const auto some = tasks.subspan(first, last - first);
    for (size_t i = 0; i < some.size(); ++i) {
      Task& t = some[i];
      const auto slot = static_cast<size_t>(t.slot);
      t.was = static_cast<Occlusion>(states[slot]);
      uint8_t unkept = kUnknown;
      uint8_t& others = keepsOthers ? allOthers[slot] : unkept;
      if (t.isNew) others = kUnknown;
      if (isLeftOut(leftOutBy, static_cast<uint32_t>(db_.lights_[slot].footprint.y))) {
        t.state = Occlusion::full;
        others = static_cast<uint8_t>(Occlusion::full);
      } else if (t.work != Work::inherit) {
        if (t.met.object == kNone) t.met = met;
        if (t.metMover.object == kNone) t.metMover = metMover;
        t.state =
            check(p, region, t, {some, i, shaft}, t.isSieved, others, t.met, t.metMover, tests);
        met = t.met;
        metMover = t.metMover;
      }
      if (t.state == t.was) continue;
      states[slot] = static_cast<uint8_t>(t.state);
      changed = true;
    }
    if (tests > 0) tests_ += tests;
    return changed;
  };
  if (isInherited || tasks.size() < kLightsToShare) return computeSome(0, tasks.size());
  std::atomic<bool> changed = false;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, tasks.size(), kLightsAPiece),
                    [&](const tbb::blocked_range<size_t>& range) {
                      if (computeSome(range.begin(), range.end())) changed = true;
                    });
  return changed;
}

// Null: the light is alone.
const Occluders::Candidates* VisibilityDatabase::Update::candidatesOf(
    const Place& place, const PatchRegion& region) const {
  const auto clusterOf = [&](size_t i) {
    const Task& task = place.tasks[i];
    return task.work == Work::anew ? db_.clusters_.clusterOf[static_cast<size_t>(task.slot)] : -1;
  };
  const int cluster = clusterOf(place.index);
  if (!db_.useClusters_ || region.count != 4 || cluster < 0) return nullptr;
  Shaft& shaft = place.shaft;
  if (shaft.cluster != cluster || place.index >= shaft.last) {
    shaft.cluster = cluster;
    shaft.first = shaft.last = place.index;
    while (shaft.last < place.tasks.size() && clusterOf(shaft.last) == cluster) ++shaft.last;
    shaft.candidates.isWhole = false;
    if (shaft.last - shaft.first >= kLightsAShaft) {
      std::array<const shared::Vpl*, 64> lights;
      const size_t count = std::min(lights.size(), shaft.last - shaft.first);
      for (size_t i = 0; i < count; ++i)
        lights[i] = &db_.lights_[static_cast<size_t>(place.tasks[shaft.first + i].slot)];
      shaft.shaft = LightShaft({lights.data(), count}, region);
      db_.occluders_.collect(shaft.shaft, db_.movers_, shaft.candidates);
    }
  }
  const bool isIn = shaft.candidates.isWhole && shaft.shaft.holds(place.index - shaft.first);
  return isIn ? &shaft.candidates : nullptr;
}

// Table 4-1: where nothing that moved can be between, before or now, nothing is looked at.
Occlusion VisibilityDatabase::Update::check(const Patch& patch, const PatchRegion& region,
                                            const Task& task, const Place& place, bool& isSieved,
                                            uint8_t& others, Blocker& met, Blocker& metMover,
                                            uint64_t& tests) const {
  const shared::Vpl& vpl = db_.lights_[static_cast<size_t>(task.slot)];
  isSieved = false;
  if (others == static_cast<uint8_t>(Occlusion::full)) return Occlusion::full;
  const bool wasFound = task.work == Work::check && !task.isOfMover && !task.parentWasNone;
  isSieved = wasFound && !task.column->mayFallOn(patch.centre, patch.radius);
  if (isSieved) return task.was;
  // What all hid, and the movers did not, the others hide.
  if (wasFound && others == kUnknown && task.was == Occlusion::full && task.column->moversAreAll &&
      task.column->moversHidNothing) {
    others = static_cast<uint8_t>(Occlusion::full);
    return Occlusion::full;
  }
  if (isDecided(others)) return static_cast<Occlusion>(others);
  const OcclusionPyramid pyramid(vpl, region);
  // Where nothing stood between, only the movers can.
  if (wasFound && task.column->moversAreAll && task.was == Occlusion::none)
    others = static_cast<uint8_t>(Occlusion::none);
  if (others == kUnknown) {
    if (!pyramid.isDark()) ++tests;
    const Occluders::Candidates* candidates =
        pyramid.isDark() || pyramid.isDegenerate() ? nullptr : candidatesOf(place, region);
    others = static_cast<uint8_t>(
        candidates != nullptr
            ? db_.occluders_.occlusionAmong(scene_, pyramid, *candidates, db_.movers_, met)
            : db_.occluders_.occlusionWithout(scene_, pyramid, db_.movers_, met));
  }
  const auto state = static_cast<Occlusion>(others);
  if (state == Occlusion::full) return state;
  return std::max(state, db_.occluders_.occlusionBy(scene_, pyramid, db_.movers_, metMover));
}

// Adds the tasks of a part of a divided patch after those of the patch, which are done. One that
// was or becomes none or full tells its parts so (table 4-1).
void VisibilityDatabase::Update::passDown(uint32_t object, int patch, int child, bool wasDivided,
                                          size_t first, size_t last) {
  const Row& row = db_.rows_[object][static_cast<size_t>(child)];
  const bool childIsDivided = db_.isDivided(object, child);
  const auto pass = [&](const Task& parent) {
    // Most entries that a mover may touch are decided by the others.
    const auto s = static_cast<size_t>(parent.slot);
    if (parent.work == Work::check && parent.state == Occlusion::partial && !childIsDivided &&
        !row.withoutMovers.empty() && isDecided(row.withoutMovers[s]) &&
        row.states[s] == row.withoutMovers[s])
      return;
    Task task = parent;
    const bool wasAlike = task.was != Occlusion::partial || !wasDivided;
    if (task.state != Occlusion::partial) {
      if (!task.isNew && wasAlike && task.was == task.state) return;
      task.work = Work::inherit;
    } else if (task.work != Work::check || task.was == Occlusion::full ||
               (task.was == Occlusion::partial && !wasDivided)) {
      task.work = Work::anew;
    } else if (task.isSieved) {
      return;
    }
    task.parentWasNone = task.was == Occlusion::none;
    tasks_.push_back(task);
  };
  if (wasDivided) {
    for (size_t t = first; t < last; ++t) pass(tasks_[t]);
    return;
  }
  // Lights of which nothing changed here are to be looked at as well.
  const uint8_t* states = db_.rows_[object][static_cast<size_t>(patch)].states.data();
  size_t t = first;
  for (const int next : order_) {
    const auto slot = static_cast<size_t>(next);
    if (t < last && tasks_[t].slot == next) {
      pass(tasks_[t++]);
    } else if (db_.isLive_[slot] != 0 && states[slot] == static_cast<uint8_t>(Occlusion::partial)) {
      Task& task = tasks_.emplace_back();
      task.slot = static_cast<int>(slot);
      task.work = Work::anew;
      // A column that waits has taken in what moved here, but not elsewhere.
      if (!db_.waiting_[slot].empty())
        std::atomic_ref(db_.knowsNow_[slot]).store(1, std::memory_order_relaxed);
    }
  }
}

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
                        update.run(roots[i].first, roots[i].second, tasks);
                    });
  tests_ += tests;
}

VisibilityDatabase::Column VisibilityDatabase::takeWaiting(int slot) {
  const auto i = static_cast<size_t>(slot);
  const shared::Vpl& vpl = lights_[i];
  Column column;
  column.slot = slot;
  const auto add = [&](const Caster& caster) {
    const ShadowReach reach(vpl, caster);
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
  std::vector<Column> columns;
  for (const int slot : slots)
    if (isLight(lights_[static_cast<size_t>(slot)])) columns.push_back(takeWaiting(slot));
  std::sort(columns.begin(), columns.end(),
            [](const Column& a, const Column& b) { return a.slot < b.slot; });

  // Of objects that a column waits for all entries are looked at.
  std::vector<bool> isWaitedFor(patches_.size(), false);
  for (const Column& c : columns)
    for (const int object : c.objects) isWaitedFor[static_cast<size_t>(object)] = true;

  // Columns that reach what the trees come to: those of a node follow those of its parent.
  std::vector<uint32_t> reaching;
  std::vector<size_t> begins;
  const auto narrow = [&](const vec3& centre, float radius) {
    const size_t first = begins.back(), last = reaching.size();
    begins.push_back(last);
    for (size_t i = first; i < last; ++i)
      if (columns[reaching[i]].mayFallOn(centre, radius)) reaching.push_back(reaching[i]);
    return reaching.size() > last;
  };
  const auto narrowToBox = [&](const Bounds& b) { return narrow(b.centre(), b.radius()); };
  const auto widen = [&] {
    reaching.resize(begins.back());
    begins.pop_back();
  };
  struct Job {
    uint32_t object;
    int root;
    std::vector<Task> tasks;
    void add(const Column& column, bool isOfMover) {
      Task& task = tasks.emplace_back();
      task.column = &column;
      task.slot = column.slot;
      task.work = Work::check;
      task.isOfMover = isOfMover;
    }
  };
  std::vector<Job> jobs;
  begins.push_back(0);
  for (uint32_t c = 0; c < columns.size(); ++c) reaching.push_back(c);
  tree_.descend(
      narrowToBox,
      [&](uint32_t object) {
        if (isWaitedFor[object]) return;
        patches_[object].tree.descend(
            narrowToBox,
            [&](uint32_t r) {
              const int root = patches_[object].roots[r];
              const Patch& p = patches_[object].patches[static_cast<size_t>(root)];
              if (narrow(p.centre, p.radius)) {
                Job& job = jobs.emplace_back(Job{object, root, {}});
                for (size_t i = begins.back(); i < reaching.size(); ++i)
                  job.add(columns[reaching[i]], false);
              }
              widen();
            },
            widen);
      },
      widen);
  for (uint32_t object = 0; object < patches_.size(); ++object) {
    if (!isWaitedFor[object]) continue;
    for (const int root : patches_[object].roots) {
      const Patch& p = patches_[object].patches[static_cast<size_t>(root)];
      Job& job = jobs.emplace_back(Job{object, root, {}});
      for (const Column& c : columns) {
        const bool isOfMover = std::find(c.objects.begin(), c.objects.end(),
                                         static_cast<int>(object)) != c.objects.end();
        if (isOfMover || c.mayFallOn(p.centre, p.radius)) job.add(c, isOfMover);
      }
    }
  }
  std::vector<int> order(lights_.size());
  std::iota(order.begin(), order.end(), 0);
  std::atomic<uint64_t> tests = 0;
  tbb::parallel_for(size_t{0}, jobs.size(), [&](size_t i) {
    Update(*this, scene, false, order, tests).run(jobs[i].object, jobs[i].root, jobs[i].tasks);
  });
  tests_ += tests;
}

}  // namespace lamplighter
