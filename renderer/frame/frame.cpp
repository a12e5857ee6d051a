#include "renderer/frame/frame.h"

#include <utility>

#include "renderer/registry/registry.h"

namespace lamplighter {

FrameRenderer::FrameRenderer(std::unique_ptr<Backend> backend, Stopwatch stopwatch,
                             StageTimes stageTimes)
    : backend_(std::move(backend)), stopwatch_(std::move(stopwatch)), stageTimes_(stageTimes) {}

FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::update(const Scene& scene, const SceneChanges& changes) {
  try {
    pending_.merge(world_.update(scene, changes));
  } catch (...) {
    forget();
    throw;
  }
  hasOtherScene_ |= changes.everything;
}

GiOutput FrameRenderer::render(const Request& request) {
  // 1. Update the scene in world space and its rays from the changes.
  update(request.scene, request.changes);
  try {
    return renderUpdated(request);
  } catch (...) {
    forget();
    throw;
  }
}

GiOutput FrameRenderer::renderUpdated(const Request& request) {
  // 2. Update the backend.
  const RenderSceneChanges changes = std::exchange(pending_, {});
  const bool isOtherScene = std::exchange(hasOtherScene_, false);
  const RenderScene& scene = world_.scene();
  const RayCaster& rays = *world_.rays();
  if (!changes.none()) backend_->setScene(scene, changes, rays);

  // 3. Run the method; create it if another one is requested.
  if (!method_ || methodName_ != request.method) {
    method_ = runnableMethod(request.method, *backend_).make(*backend_);
    methodName_ = request.method;
  } else if (isOtherScene) {
    method_->reset();  // another scene: nothing of the previous one may remain
  }
  services_.beginFrame(scene, changes, rays, request.budget, isOtherScene);
  const View view = world_.viewOf(request.view);
  GiOutput output =
      method_->render({scene, changes, view, *backend_, services_, request.settings, frame_++,
                       stopwatch_, stageTimes_, request.lightOnly, request.part});
  backend_->checkDevice();
  return output;
}

// Drops what is computed from the scene, except the scene in world space and its rays.
void FrameRenderer::forget() {
  method_.reset();
  backend_->reset();
  Services fresh;
  fresh.setCacheFolder(services_.cacheFolder());
  services_ = std::move(fresh);
  pending_ = {};
  pending_.rebuilt = true;
}

void FrameRenderer::setBackend(std::unique_ptr<Backend> backend) {
  forget();
  backend_ = std::move(backend);
}

void FrameRenderer::restart() {
  if (method_) method_->reset();
}

}  // namespace lamplighter
