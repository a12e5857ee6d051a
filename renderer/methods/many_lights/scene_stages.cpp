// The stages of ManyLights that update visibility, light maps and transfer.
#include <algorithm>
#include <functional>
#include <utility>

#include "renderer/methods/many_lights/many_lights.h"

namespace lamplighter {
namespace {

// Number of tests for the columns that a frame may refresh.
uint64_t mostTestsOfNewPatches(const VisibilityDatabase& visibility,
                               const ManyLightsOptions& options) {
  const RefreshBudget budget = options.budget();
  const auto columns = static_cast<uint64_t>(std::max(budget.vpls, 1));
  const uint64_t aColumn = std::max<uint64_t>(visibility.testsPerColumn(), 256);
  return std::min(columns * aColumn, std::max<uint64_t>(budget.work.visibilityTests, 1));
}

}  // namespace

void ManyLights::takeScene(const FrameInputs& in, const Options& options) {
  if (!options.useVisibility()) {
    visibility_.reset();
    demandIsCurrent_ = false;
    return;
  }
  RenderSceneChanges changes = in.changes;
  if (!visibility_) {
    visibility_ = std::make_unique<VisibilityDatabase>(in.services.cacheFolder());
    demand_ = {};
    demandIsCurrent_ = false;
    changes.rebuilt = true;
  }
  visibility_->limitMemory(options.visibilityBytes());
  visibility_->setScene(in.scene, changes);
}

// While the camera or an object moves, patches that had entries keep them, except if all had some:
// these were few, and a large object has come.
void ManyLights::askForPatches(const FrameInputs& in, const Options& options) {
  const bool isMoving = in.changes.surfaces() || (started_ && in.view != view_);
  if (!isMoving && demandIsCurrent_) return;
  const size_t mostRows = options.visibilityBytes() /
                          VisibilityDatabase::rowBytes(static_cast<size_t>(lights_.slots()) + 1);
  PatchDemand demand =
      findPatchDemand(visibility_->patches(), in.services.rays(), in.view, mostRows);
  demandIsCurrent_ = !isMoving || !started_ || demand.isForAll;
  if (!demandIsCurrent_ && !demand_.isForAll) demand.add(demand_);
  if (demand == demand_ && !in.changes.surfaces()) return;
  demand_ = std::move(demand);
  visibility_->ask(demand_);
  patchesChanged_ = true;
}

void ManyLights::updateVisibility(const FrameInputs& in, Options& options, ManyLightsStats& stats) {
  if (!visibility_) return;
  askForPatches(in, options);
  const LightSampleTable& lights = lights_.table();
  visibilityNeeds_ = visibility_->leastBytes(lights.slots());
  neededFor_ = lights_.slots();
  if (visibilityNeeds_ > options.visibilityBytes()) {
    visibility_.reset();
    options.forgoVisibility();
    return;
  }
  const uint64_t before = visibility_->tests();
  visibility_->setLights(in.scene, lights.summed);
  // Lights whose maps still show a mover at its old position wait.
  const std::vector<bool> upToDate = lights.where(std::mem_fn(&LightSample::isUpToDate));
  std::vector<int> slots;
  for (int slot = 0; slot < lights_.slots(); ++slot)
    if (upToDate[static_cast<size_t>(slot)]) slots.push_back(slot);
  visibility_->refresh(in.scene, slots);
  // New patches get as many tests as the columns that a frame may refresh.
  const size_t unanswered = visibility_->unanswered();
  visibility_->answer(in.scene, mostTestsOfNewPatches(*visibility_, options));
  patchesChanged_ = patchesChanged_ || visibility_->unanswered() != unanswered;
  stats.patchesPending = static_cast<int>(visibility_->unanswered());
  stats.visibilityTests = visibility_->tests() - before;
}

LightMaps::Options ManyLights::lightMapOptions(const Options& options) const {
  return {options.lightMapTexel, options.clampDistance, options.lightMapBytes(),
          kernels_->traits().mostLightMapTexels};
}

void ManyLights::updateLightMaps(const FrameInputs& in, const Options& options,
                                 ManyLightsStats& stats) {
  if (!options.useLightMaps()) {
    lightMaps_.reset();
  } else {
    if (!lightMaps_) lightMaps_ = std::make_unique<LightMaps>();
    const uint64_t before = lightMaps_->texelsWritten();
    const bool isAtRest = in.changes.none() && lights_.pending() == 0;
    lightMaps_->update(in.scene, *visibility_, lights_.table().summed, lightMapOptions(options),
                       &in.view, isAtRest);
    stats.lightMapTexels = lightMaps_->texelsWritten() - before;
    stats.lightMapTexel = lightMaps_->texel();
    stats.lightMapsWithoutRoom = stats.lightMapTexel == 0.0f;
  }
}

// Returns whether the picture changes.
bool ManyLights::updatePrt(const FrameInputs& in, const Options& options, ManyLightsStats& stats) {
  if (!options.prt) {
    prt_.reset();
    return false;
  }
  // The first call after enabling treats everything as changed.
  RenderSceneChanges changes = in.changes;
  if (!prt_) {
    prt_ = std::make_unique<PrtLights>(TransferCache(in.services.cacheFolder()), computeTransfer_);
    changes.rebuilt = true;
  }
  const uint64_t before = prt_->rays();
  const LightSampleTable& lights = lights_.table();
  const auto isLast = [&](const LightSample& l) {
    return static_cast<int>(l.id.bounce) >= options.bounces;
  };
  const bool changed = prt_->update(
      in.scene, changes, in.services.rays(), *visibility_,
      {lights.summed, lights.where(std::mem_fn(&LightSample::isUpToDate)), lights.where(isLast)},
      options.transfer(), !in.services.budget().inBackground);
  stats.raysTraced += prt_->rays() - before;
  const Transfers::Progress progress = prt_->progress();
  stats.transfersPending = static_cast<int>(progress.pending);
  stats.transferShare = progress.share;
  const PrtLights::Left left = prt_->left();
  stats.transferObjects = left.objects;
  stats.transferObjectsLeft = left.wholly;
  stats.transferLightsLeft = left.lights;
  stats.transferObjectsWithoutRoom = left.withoutRoom;
  return changed;
}

}  // namespace lamplighter
