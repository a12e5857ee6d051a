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

// Maximum number of rays per frame: about 25 ms on two cores.
constexpr uint64_t kRaysAFrame = 150'000;
// Pixels of a picture at rest that a frame adds: about 50 ms if all of them are glossy.
constexpr int kPixelsAFrame = 150'000;

int rowsAFrame(const View& view) { return std::max(1, kPixelsAFrame / view.width); }

}  // namespace

void BouncedPicture::update(const FrameInputs& in, const SurfaceLightOptions& light,
                            const SurfacePictureOptions& picture, float pace) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  scene_ = &in.scene;
  const bool isLive = !changes.none() || !(in.view == view_);
  pace_ = isLive ? std::min(pace, 1.0f) : 1.0f;
  const auto most = static_cast<uint64_t>(pace_ * static_cast<float>(kRaysAFrame));
  hasOtherLight_ = light_.update(in.scene, changes, in.services.rays(), light, most);
  if (hasOtherLight_) {
    shown_ = nullptr;
    still_.outdateLight();
    smooth_.outdateLight();
  }
  raysLeft_ = std::max(most / 4, most - std::min(most, light_.counts().rays));
  const bool isOtherView =
      !(in.view == view_) || light.seed != seed_ || light.projection != projection_;
  if (isOtherView) records_.restart(in.view, light.seed, light.projection);
  records_.outdate(gatherScene(in), light_);
  isAtRest_ = light_.keptMesh() && !isOtherView;
  // Pixels keep their positions on the elements only if nothing in the scene changes.
  if (isAtRest_ && picture == options_) return;
  recordsAreOutdated_ = true;
  keepsPixels_ = !isOtherView && picture == options_ && !light_.hasOtherElements() &&
                 !changes.materials && moving_.samples() == 1;
  if (!keepsPixels_) moving_ = {};
  still_ = smooth_ = {};
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
  // Only in frames without a change: during a motion these rays would be traced again each time.
  // Not while records are chosen either, because that discards the pixels, if these take several
  // frames.
  const bool hasTime =
      isAtRest_ && !hasOtherLight_ && (records_.isDone() || rowsAFrame(view_) >= view_.height);
  if (hasTime && !still_.isComplete())
    goOn(in, still_, 1, gbufferIsCurrent);
  else if (hasTime && antialias > 1 && !isSmooth(antialias) && records_.isDone())
    goOn(in, smooth_, antialias, gbufferIsCurrent);
  RestingPicture* resting = isSmooth(antialias)   ? &smooth_
                            : still_.isComplete() ? &still_
                                                  : nullptr;
  if (resting == nullptr && (moving_.samples() == 0 || keepsPixels_))
    drawMoving(in, gbufferIsCurrent);
  const int shownOf = resting != nullptr ? resting->samples() : 0;
  if (shown_ && picture == under_ && shownOf == shownOf_) return shown_;
  Image sum = picture->pixels();
  if (resting != nullptr)
    resting->addTo(gatherScene(in), light_, records_, sum);
  else
    moving_.addTo(light_.values(), records_.values(), sum);
  under_ = picture;
  shownOf_ = shownOf;
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
  const int samples = smooth_.samples() == antialias ? smooth_.sample() : 0;
  return static_cast<int>((rays + kRaysAFrame - 1) / kRaysAFrame) +
         (antialias > 1 ? antialias - samples : 0);
}

// Records are chosen when nothing moves and samples of the mesh have all rays, because their choice
// depends on these.
void BouncedPicture::updateRecords(const FrameInputs& in, bool& gbufferIsCurrent) {
  const bool isMissing = recordsAreOutdated_ || !records_.isDone();
  if (isMissing && isAtRest_ && light_.links().isDone()) {
    showView(in, gbufferIsCurrent);
    records_.choose(gatherScene(in), light_, in.backend.hostGBuffer(), raysLeft_);
    recordsAreOutdated_ = false;
    forgetPixels();
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

void BouncedPicture::forgetPixels() {
  moving_ = {};
  still_ = smooth_ = {};
}

void BouncedPicture::goOn(const FrameInputs& in, RestingPicture& picture, int samples,
                          bool& gbufferIsCurrent) {
  if (picture.samples() != samples) picture.restart(view_, samples, seed_);
  if (samples == 1) {
    showView(in, gbufferIsCurrent);
  } else {
    in.backend.renderGBuffer(view_, pixelJitter(picture.sample(), samples));
    gbufferIsCurrent = false;
  }
  picture.add(gatherScene(in), light_, records_, in.backend.hostGBuffer(), options_,
              rowsAFrame(view_));
}

void BouncedPicture::drawMoving(const FrameInputs& in, bool& gbufferIsCurrent) {
  showView(in, gbufferIsCurrent);
  const GBufferView gbuffer = in.backend.hostGBuffer();
  if (std::exchange(keepsPixels_, false) && moving_.samples() == 1) {
    moving_.replaceChanged(gatherScene(in), light_, records_, gbuffer, view_.eye, options_);
    return;
  }
  moving_.restart(view_.width, view_.height, 1);
  moving_.add(gatherScene(in), light_, records_, gbuffer, view_.eye, options_, {0, view_.height});
}

}  // namespace lamplighter
