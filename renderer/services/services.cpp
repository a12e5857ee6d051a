#include "renderer/services/services.h"

namespace lamplighter {

const char* nameOf(Service service) {
  static constexpr const char* kNames[] = {"rays", "movers", "surfaces", "charts"};
  return kNames[static_cast<size_t>(service)];
}

void Services::beginFrame(const RenderScene& scene, const RenderSceneChanges& changes,
                          const RayCaster& rays, const FrameBudget& budget, bool isOtherScene) {
  scene_ = &scene;
  rays_ = &rays;
  budget_ = budget;
  movers_.reset();
  unseenByMovers_.merge(changes);
  unseenBySurfaces_.merge(changes);
  if (charts_) charts_->outdate(changes);
  if (isOtherScene) moverFinder_.reset();
}

const RayCaster& Services::rays() {
  note(Service::rays);
  return *rays_;
}

std::span<const MoverFinder::Mover> Services::movers() {
  note(Service::movers);
  if (!movers_) movers_ = moverFinder_.update(*scene_, std::exchange(unseenByMovers_, {}));
  return *movers_;
}

const SurfaceSampler& Services::surfaces() {
  note(Service::surfaces);
  const RenderSceneChanges changes = std::exchange(unseenBySurfaces_, {});
  if (!surfaces_)
    surfaces_.emplace(*scene_);
  else
    surfaces_->update(*scene_, changes);
  return *surfaces_;
}

std::span<const ObjectAtlas> Services::charts(float texelsPerMetre) {
  note(Service::charts);
  if (!charts_) charts_ = std::make_unique<ObjectCharts>(cacheFolder_);
  return charts_->find(*scene_, texelsPerMetre);
}

}  // namespace lamplighter
