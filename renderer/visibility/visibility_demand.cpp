// Gives entries to the patches that are asked for, and drops those that are not.
#include <algorithm>
#include <atomic>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/scene/light_linking.h"
#include "renderer/scene/vpl.h"
#include "renderer/visibility/visibility_update.h"

namespace lamplighter {
namespace {

// Roots that are computed before the number of tests is compared with its limit.
constexpr size_t kRootsAStep = 8;

constexpr auto kPartial = static_cast<uint8_t>(Occlusion::partial);
constexpr auto kFull = static_cast<uint8_t>(Occlusion::full);

}  // namespace

void VisibilityDatabase::fillWithoutEntries(const RenderScene& scene) {
  leftOutBy_.resize(scene.objects.size());
  leftOutEntries_.clear();
  partialEntries_.assign(stride_, kPartial);
  for (size_t object = 0; object < scene.objects.size(); ++object) {
    const uint32_t bits = leftOutBy_[object] = scene.objects[object].leftOutBy;
    if (bits == 0) continue;
    const auto [it, isNew] = leftOutEntries_.try_emplace(bits, partialEntries_);
    for (size_t slot = 0; isNew && slot < lights_.size(); ++slot)
      if (isLeftOut(bits, static_cast<uint32_t>(lights_[slot].footprint.y)))
        it->second[slot] = kFull;
  }
}

// The entries of a new root, until its columns are computed.
void VisibilityDatabase::giveRow(uint32_t object, int root) {
  rows_[object][static_cast<size_t>(root)].states = withoutEntries(object);
}

void VisibilityDatabase::dropRoot(uint32_t object, int root) {
  std::vector<int> open{root};
  while (!open.empty()) {
    const auto patch = static_cast<size_t>(open.back());
    open.pop_back();
    if (divided_[object][patch] != 0) {
      const int first = patches_[object].patches[patch].firstChild;
      open.insert(open.end(), {first, first + 1});
    }
    rows_[object][patch] = Row();
    divided_[object][patch] = 0;
  }
  given_[object][static_cast<size_t>(root)] = 0;
  changed_[object][static_cast<size_t>(root)] = 1;
}

void VisibilityDatabase::ask(const PatchDemand& demand) {
  demand_ = demand;
  wasAsked_ = true;
  unanswered_ = 0;
  askedAtLevels_.assign(1, 0);
  for (uint32_t object = 0; object < patches_.size(); ++object) {
    for (const int root : patches_[object].roots) {
      const uint8_t asked = levelsAsked(object, root), given = levelsGiven(object, root);
      if (!demand_.isForAll) {
        askedAtLevels_.resize(std::max<size_t>(askedAtLevels_.size(), asked), 0);
        for (size_t level = 0; level < asked; ++level) askedAtLevels_[level] += size_t{1} << level;
      }
      if (asked == given) continue;
      // Without lights nothing is computed yet.
      const bool isEmpty = rows_[object][static_cast<size_t>(root)].states.empty();
      if (given > 0 && (asked == 0 || isEmpty)) dropRoot(object, root);
      if (asked > 0) ++unanswered_;
    }
  }
  limitChanged_ = takeMemoryLimit(stride_) || limitChanged_;
}

void VisibilityDatabase::answer(const RenderScene& scene, uint64_t mostTests) {
  if (unanswered_ == 0) return;
  struct Root {
    uint32_t object;
    int patch;
    uint8_t levels;
  };
  std::vector<Root> roots;
  for (uint32_t object = 0; object < patches_.size(); ++object) {
    for (const int root : patches_[object].roots) {
      const uint8_t asked = levelsAsked(object, root);
      if (asked > 0 && asked != levelsGiven(object, root)) roots.push_back({object, root, asked});
    }
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [](const Root& a, const Root& b) { return a.levels > b.levels; });
  std::vector<Task> all;
  for (const int slot : clusters_.order) {
    if (isLive_[static_cast<size_t>(slot)] == 0) continue;
    Task& task = all.emplace_back();
    task.slot = slot;
    task.isNew = true;
  }
  std::atomic<uint64_t> tests = 0;
  size_t done = 0;
  while (done < roots.size() && tests < mostTests) {
    const size_t end = std::min(done + kRootsAStep, roots.size());
    tbb::parallel_for(done, end, [&](size_t i) {
      const Root& root = roots[i];
      uint8_t& given = given_[root.object][static_cast<size_t>(root.patch)];
      const bool isNew = std::exchange(given, root.levels) == 0;
      if (isNew) giveRow(root.object, root.patch);
      changed_[root.object][static_cast<size_t>(root.patch)] = 1;
      Update update(*this, scene, true, clusters_.order, tests);
      update.run(root.object, root.patch,
                 isNew ? std::span<const Task>(all) : std::span<const Task>(), {});
    });
    done = end;
  }
  tests_ += tests;
  unanswered_ = roots.size() - done;
  // These roots already know the present positions of the movers.
  for (size_t slot = 0; slot < lights_.size(); ++slot)
    if (done > 0 && isWaiting(static_cast<int>(slot))) knowsNow_[slot] = 1;
}

}  // namespace lamplighter
