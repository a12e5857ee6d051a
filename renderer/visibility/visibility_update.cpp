#include "renderer/visibility/visibility_update.h"

#include <tbb/parallel_for.h>

#include "renderer/base/simd.h"
#include "renderer/visibility/visibility_piece.h"

namespace lamplighter {
namespace {

// Smallest number of lights per job of a thread: several times the number that is tested together.
constexpr size_t kLightsAPiece = 16;
constexpr size_t kLightsToShare = 32;  // fewer are not distributed over threads

// Number of partial entries of live lights (isLive is 1 or 0).
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

}  // namespace

void VisibilityDatabase::Update::run(uint32_t object, int root, std::span<const Task> tasks,
                                     std::span<const uint64_t> simple) {
  tasks_.assign(tasks.begin(), tasks.end());
  simple_.assign(simple.begin(), simple.end());
  simpleWords_ = simple.size();
  levels_ = std::min<size_t>(db_.levels_, db_.given_[object][static_cast<size_t>(root)]);
  const Patch& p = db_.patches_[object].patches[static_cast<size_t>(root)];
  bool any = !tasks.empty();
  for (size_t w = 0; w < simpleWords_; ++w) {
    simple_[w] = simpleColumns_->reaches.mayFallOn(w, simple_[w], p.centre, p.radius);
    any = any || simple_[w] != 0;
  }
  if (!any && !allMayDivide_) return;
  visit(object, root, 0, 0, allMayDivide_);
}

// Processes a patch and all divided patches below it. If neither the patch nor a light is new and
// no entry changed, the division stays as it was.
void VisibilityDatabase::Update::visit(uint32_t object, int patch, size_t level, size_t first,
                                       bool mayDivide) {
  const auto index = static_cast<size_t>(patch);
  if (simpleWords_ > 0) checkSimple(object, patch, first, simpleAt(level));
  const size_t last = tasks_.size();
  const bool changedBefore = db_.changed_[object][index] != 0;
  const std::span<Task> tasks = std::span(tasks_).subspan(first);
  // A new light counts even if its entry equals the previous one of the slot; so does each light on
  // an object that was placed again.
  mayDivide = mayDivide || std::any_of(tasks.begin(), tasks.end(),
                                       [](const Task& t) { return t.isNew || t.isOfMover; });
  if (compute(object, patch, tasks)) {
    db_.changed_[object][index] = 1;
    mayDivide = true;
  }
  const Patch& p = db_.patches_[object].patches[index];
  if (p.isLeaf()) return;
  const bool was = db_.isDivided(object, patch);
  const bool is = mayDivide ? level + 1 < levels_ &&
                                  countPartial(db_.row(object, patch), db_.isLive_) > db_.most_
                            : was;
  if (was && !is) forgetParts(object, patch);
  if (!is) return;
  if (!was) beginParts(object, patch, std::span(tasks_).subspan(first), changedBefore);
  for (int child = p.firstChild; child < p.firstChild + 2; ++child) {
    passDown(object, patch, child, was, first, last);
    const bool isSimple = simpleWords_ > 0 && passSimpleDown(level, was);
    if (tasks_.size() > last || isSimple || !was || allMayDivide_)
      visit(object, child, level + 1, last, !was || allMayDivide_);
    tasks_.resize(last);
  }
}

// Until now the parts shared the entries of the patch, as they were before its tasks.
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

// After this the parts share the entries of the patch.
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

// Computes all tasks at one patch. Returns whether an entry changed.
bool VisibilityDatabase::Update::compute(uint32_t object, int patch, std::span<Task> tasks) {
  if (tasks.empty()) return false;
  const ObjectPatches& patches = db_.patches_[object];
  const Patch& p = patches.patches[static_cast<size_t>(patch)];
  Row& row = db_.rows_[object][static_cast<size_t>(patch)];
  // If nothing moves, the state without movers is the state itself.
  const bool keepsOthers = db_.keepsOthers_ && !db_.movers_.empty();
  if (keepsOthers && row.withoutMovers.empty()) row.withoutMovers.assign(db_.stride_, kUnknown);
  const auto toLookAt = static_cast<size_t>(std::count_if(
      tasks.begin(), tasks.end(), [](const Task& t) { return t.work != Work::inherit; }));
  const PatchRegion region =
      toLookAt == 0 ? PatchRegion(Bounds()) : PatchRegion(scene_, object, patches, p);
  if (hints_.size() < tasks_.size()) hints_.resize(tasks_.size());
  const auto computeSome = [&](size_t first, size_t last) {
    Piece piece(*this, scene_.objects[object].leftOutBy, p, region, row, keepsOthers);
    return piece.run(tasks.subspan(first, last - first));
  };
  if (toLookAt < kLightsToShare) return computeSome(0, tasks.size());
  std::atomic<bool> changed = false;
  const size_t pieces = toLookAt / kLightsAPiece;
  tbb::parallel_for(size_t{0}, pieces, [&](size_t i) {
    if (computeSome(i * tasks.size() / pieces, (i + 1) * tasks.size() / pieces)) changed = true;
  });
  return changed;
}

// Appends the tasks of a part of a divided patch after the finished tasks of the patch. If an entry
// of the patch was or becomes none or full, the parts inherit it (table 4-1).
void VisibilityDatabase::Update::passDown(uint32_t object, int patch, int child, bool wasDivided,
                                          size_t first, size_t last) {
  const Row& row = db_.rows_[object][static_cast<size_t>(child)];
  const bool childIsDivided = db_.isDivided(object, child);
  tasks_.reserve(tasks_.size() + order_.size());  // parents are among them
  const auto pass = [&](const Task& parent) {
    // Most entries that a mover may affect are decided by the other objects.
    const auto s = static_cast<size_t>(parent.slot);
    if (parent.work == Work::check && parent.state == Occlusion::partial && !childIsDivided &&
        !row.withoutMovers.empty() && isDecided(row.withoutMovers[s]) &&
        row.states[s] == row.withoutMovers[s])
      return;
    Work work = Work::check;
    if (parent.state != Occlusion::partial) {
      const bool wasAlike = parent.was != Occlusion::partial || !wasDivided;
      if (!parent.isNew && wasAlike && parent.was == parent.state) return;
      work = Work::inherit;
    } else if (parent.work != Work::check || parent.was == Occlusion::full ||
               (parent.was == Occlusion::partial && !wasDivided)) {
      work = Work::anew;
    } else if (parent.isSieved) {
      return;
    }
    Task& task = tasks_.emplace_back(parent);
    task.work = work;
    task.isFound = false;
    task.parentWasNone = parent.was == Occlusion::none;
  };
  if (wasDivided) {
    for (size_t t = first; t < last; ++t) pass(tasks_[t]);
    return;
  }
  // Lights for which nothing changed at this patch must be tested as well.
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
      // A waiting column has processed the movement here, but not elsewhere.
      if (!db_.waiting_[slot].empty())
        std::atomic_ref(db_.knowsNow_[slot]).store(1, std::memory_order_relaxed);
    }
  }
}

}  // namespace lamplighter
