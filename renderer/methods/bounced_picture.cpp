#include "renderer/methods/bounced_picture.h"

#include <algorithm>
#include <utility>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/mesh_senders.h"
#include "renderer/methods/pixel_jitter.h"
#include "renderer/methods/surface_elements.h"
#include "renderer/surface_light/pixels/mesh_mirror.h"

namespace lamplighter {

namespace {

// Rays of a frame: some 25 ms on two cores.
constexpr uint64_t kRaysAFrame = 150'000;

}  // namespace

void BouncedPicture::update(const FrameInputs& in, const SurfaceLightOptions& light,
                            const SurfacePictureOptions& picture, float pace) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  scene_ = &in.scene;
  const bool isLive = !changes.none() || !(in.view == view_);
  pace_ = isLive ? std::min(pace, 1.0f) : 1.0f;
  const auto most = static_cast<uint64_t>(pace_ * static_cast<float>(kRaysAFrame));
  hasOtherLight_ = light_.update(in.scene, changes, in.services.rays(), light, most);
  if (hasOtherLight_) shown_ = nullptr;
  raysLeft_ = std::max(most / 4, most - std::min(most, light_.counts().rays));
  const bool isOtherView =
      !(in.view == view_) || light.seed != seed_ || light.projection != projection_;
  if (isOtherView) records_.restart(in.view, light.seed, light.projection);
  records_.outdate(gatherScene(in), light_);
  isAtRest_ = light_.keptMesh() && !isOtherView;
  // Pixels keep their places on the elements only if nothing of the scene changes.
  if (isAtRest_ && picture == options_) return;
  recordsAreOutdated_ = true;
  keepsPixels_ = !isOtherView && picture == options_ && !light_.hasOtherElements() &&
                 !changes.materials && plain_.samples() == 1 && !hasPlainLobes_;
  if (!keepsPixels_) forgetPlain();
  smooth_ = {};
  shown_ = nullptr;
  view_ = in.view;
  seed_ = light.seed;
  projection_ = light.projection;
  options_ = picture;
}

std::shared_ptr<RadianceImage> BouncedPicture::addTo(const FrameInputs& in,
                                                     const std::shared_ptr<RadianceImage>& picture,
                                                     int antialias, bool& gbufferIsCurrent) {
  updateRecords(in, gbufferIsCurrent);
  if (antialias > 1 && smooth_.samples() < antialias && records_.isDone())
    addSample(in, smooth_, antialias, gbufferIsCurrent);
  const int shown = smooth_.samples() == antialias ? antialias : 1;
  // Only in frames without a change: during a motion these rays would be traced again each time.
  if (shown <= 1 && isAtRest_ && !hasPlainLobes_) {
    forgetPlain();
    hasPlainLobes_ = true;
    shown_ = nullptr;
  }
  if (shown <= 1 && (plain_.samples() == 0 || keepsPixels_))
    addSample(in, plain_, 1, gbufferIsCurrent);
  if (shown_ && picture == under_ && shown == antialias_) return shown_;
  Image sum = picture->pixels();
  (shown > 1 ? smooth_ : plain_).addTo(light_.values(), records_.values(), sum);
  (shown > 1 ? lobes_ : plainLobes_).addTo(in.scene, MeshMirror(gatherScene(in), light_), sum);
  under_ = picture;
  antialias_ = shown;
  shown_ = std::make_shared<HostImage>(std::move(sum));
  return shown_;
}

std::shared_ptr<const ElementView> BouncedPicture::elements() const {
  if (scene_ == nullptr || light_.values().empty()) return nullptr;
  return std::make_shared<SurfaceElements>(*scene_, light_);
}

InspectedLinks BouncedPicture::links() const {
  if (scene_ == nullptr || light_.values().empty() || light_.part() == SurfaceLightPart::sky)
    return nullptr;
  return [this](const InspectedPlace& place) -> std::optional<std::vector<InspectedLink>> {
    if (!unseen_.none()) return std::nullopt;
    return meshSendersTo(*scene_, light_, place);
  };
}

std::shared_ptr<const MirroredLight> BouncedPicture::surfaces(const FrameInputs& in) const {
  if (light_.reflected().empty() || light_.part() == SurfaceLightPart::sky) return nullptr;
  return std::make_shared<MeshMirror>(gatherScene(in), light_);
}

int BouncedPicture::framesLeft(int antialias) const {
  const uint64_t rays = light_.links().raysLeft() + records_.raysLeft();
  return static_cast<int>((rays + kRaysAFrame - 1) / kRaysAFrame) +
         (antialias > 1 ? antialias - smooth_.samples() : 0);
}

// Records are chosen when nothing moves and samples of the mesh have all rays, because their choice
// depends on these.
void BouncedPicture::updateRecords(const FrameInputs& in, bool& gbufferIsCurrent) {
  const bool isMissing = recordsAreOutdated_ || !records_.isDone();
  if (isMissing && isAtRest_ && light_.links().isDone()) {
    showView(in, gbufferIsCurrent);
    records_.choose(gatherScene(in), light_, in.backend.hostGBuffer(), raysLeft_);
    recordsAreOutdated_ = false;
    forgetPlain();
    smooth_ = {};
  } else if (isMissing) {
    records_.retrace(gatherScene(in), raysLeft_);
  } else if (!hasOtherLight_) {
    return;
  }
  shown_ = nullptr;
  records_.findLight(in.scene, light_);
}

void BouncedPicture::showView(const FrameInputs& in, bool& gbufferIsCurrent) {
  if (!gbufferIsCurrent) in.backend.renderGBuffer(view_, vec2(0.0f));
  gbufferIsCurrent = true;
}

void BouncedPicture::forgetPlain() {
  plain_ = {};
  plainLobes_ = {};
  hasPlainLobes_ = false;
}

void BouncedPicture::addSample(const FrameInputs& in, SurfacePicture& pixels, int samples,
                               bool& gbufferIsCurrent) {
  PixelLobes& lobes = samples > 1 ? lobes_ : plainLobes_;
  const bool withLobes = samples > 1 || hasPlainLobes_;
  const bool keepsPixels = samples == 1 && std::exchange(keepsPixels_, false);
  if (pixels.samples() == 0) {
    pixels.restart(view_.width, view_.height, samples);
    lobes.restart(view_, samples, seed_);
  }
  if (samples == 1) {
    showView(in, gbufferIsCurrent);
  } else {
    in.backend.renderGBuffer(view_, pixelJitter(pixels.samples(), samples));
    gbufferIsCurrent = false;
  }
  const GBufferView gbuffer = in.backend.hostGBuffer();
  if (keepsPixels && pixels.samples() == 1)
    pixels.replaceChanged(gatherScene(in), light_, records_, gbuffer, view_.eye, options_);
  else
    pixels.add(gatherScene(in), light_, records_, gbuffer, view_.eye, options_, withLobes);
  if (withLobes)
    lobes.add(in.scene, in.services.rays(), MeshMirror(gatherScene(in), light_), gbuffer, options_);
}

}  // namespace lamplighter
