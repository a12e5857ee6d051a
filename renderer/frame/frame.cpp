#include "renderer/frame/frame.h"

#include "renderer/registry/registry.h"

namespace lamplighter {

FrameRenderer::FrameRenderer(std::unique_ptr<Backend> backend, Stopwatch stopwatch)
    : backend_(std::move(backend)), stopwatch_(std::move(stopwatch)) {}

FrameRenderer::~FrameRenderer() = default;

GiOutput FrameRenderer::render(const Request& request) {
  // 1. The scene in world space, from what changed.
  const SceneChanges wanted = rays_ ? request.changes : SceneChanges::all();
  const RenderSceneChanges changes = update(scene_, request.scene, wanted);

  // 2. Rays see it, and the backend.
  if (!rays_) {
    rays_ = std::make_unique<RayCaster>(scene_);
  } else if (!changes.none()) {
    rays_->update(changes);
  }
  if (!changes.none()) backend_->setScene(scene_, changes, *rays_);

  // 3. The method, a new one when another is asked for.
  if (!method_ || methodName_ != request.method) {
    method_ = findMethod(request.method).make();
    methodName_ = request.method;
  } else if (request.changes.everything) {
    method_->reset();  // another scene: nothing of the last one may show in it
  }
  return method_->render({scene_, changes, *rays_, request.view, *backend_, request.settings,
                          frame_++, stopwatch_, request.lightOnly, request.inBackground,
                          cacheFolder_, request.refineUpdates, request.part});
}

void FrameRenderer::restart() {
  if (method_) method_->reset();
}

}  // namespace lamplighter
