#include "renderer/methods/bounced_picture.h"

#include <algorithm>
#include <utility>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {

namespace {

// Rays of a frame: some 40 ms on two cores.
constexpr uint64_t kRaysAFrame = 300'000;

}  // namespace

void BouncedPicture::update(const FrameInputs& in, const SurfaceLightOptions& light,
                            const SurfacePictureOptions& picture) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  if (light_.update(in.scene, changes, in.services.rays(), light, kRaysAFrame)) shown_ = nullptr;
  raysLeft_ = std::max(kRaysAFrame / 4, kRaysAFrame - std::min(kRaysAFrame, light_.counts().rays));
  if (!(in.view == view_) || light.seed != seed_) {
    records_.restart(in.view, light.seed);
    seed_ = light.seed;
  }
  // Pixels keep their places on the elements only if nothing of the scene changes.
  if (light_.keptMesh() && in.view == view_ && picture == options_) return;
  recordsAreOutdated_ = true;
  view_ = in.view;
  options_ = picture;
  plain_ = smooth_ = {};
  shown_ = nullptr;
}

std::shared_ptr<RadianceImage> BouncedPicture::addTo(const FrameInputs& in,
                                                     const std::shared_ptr<RadianceImage>& picture,
                                                     int antialias, bool& gbufferIsCurrent) {
  updateRecords(in, gbufferIsCurrent);
  if (antialias > 1 && smooth_.samples() < antialias && records_.isDone())
    addSample(in, smooth_, antialias, gbufferIsCurrent);
  const int shown = smooth_.samples() == antialias ? antialias : 1;
  if (shown <= 1 && plain_.samples() == 0) addSample(in, plain_, 1, gbufferIsCurrent);
  if (shown_ && picture == under_ && shown == antialias_) return shown_;
  Image sum = picture->pixels();
  (shown > 1 ? smooth_ : plain_).addTo(light_.values(), records_.values(), sum);
  under_ = picture;
  antialias_ = shown;
  shown_ = std::make_shared<HostImage>(std::move(sum));
  return shown_;
}

int BouncedPicture::framesLeft(int antialias) const {
  const uint64_t rays = light_.links().raysLeft() + records_.raysLeft();
  return static_cast<int>((rays + kRaysAFrame - 1) / kRaysAFrame) +
         (antialias > 1 ? antialias - smooth_.samples() : 0);
}

// Records wait until samples of the mesh have all rays, because their choice depends on these.
void BouncedPicture::updateRecords(const FrameInputs& in, bool& gbufferIsCurrent) {
  const bool isReady = light_.links().isDone();
  if (shown_ && records_.isDone() && !recordsAreOutdated_) return;
  if (!isReady && records_.values().empty()) return;
  shown_ = nullptr;
  if (recordsAreOutdated_ || !records_.isDone()) {
    if (!gbufferIsCurrent) in.backend.renderGBuffer(view_, vec2(0.0f));
    gbufferIsCurrent = true;
  }
  records_.update(gatherScene(in), light_, in.backend.hostGBuffer(), recordsAreOutdated_,
                  raysLeft_);
  recordsAreOutdated_ = !isReady;
  if (!records_.choseAnew()) return;
  plain_ = smooth_ = {};
}

void BouncedPicture::addSample(const FrameInputs& in, SurfacePicture& pixels, int samples,
                               bool& gbufferIsCurrent) {
  if (pixels.samples() == 0) pixels.restart(view_.width, view_.height, samples);
  if (samples > 1 || !gbufferIsCurrent) {
    const vec2 shift = samples > 1 ? pixelJitter(pixels.samples(), samples) : vec2(0.0f);
    in.backend.renderGBuffer(view_, shift);
  }
  gbufferIsCurrent = samples == 1;
  pixels.add(gatherScene(in), light_, records_, in.backend.hostGBuffer(), view_.eye, options_);
}

}  // namespace lamplighter
