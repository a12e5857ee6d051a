#include "renderer/methods/bounced_picture.h"

#include <utility>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {

void BouncedPicture::update(const FrameInputs& in, const SurfaceLightOptions& light,
                            const SurfacePictureOptions& picture) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  const bool isOther = light_.update(in.scene, changes, in.services.rays(), light);
  if (isOther) shown_ = nullptr;
  // The elements of a scene keep their numbers only if nothing of it changes.
  const bool isOtherMesh = changes.surfaces() || (isOther && light_.counts().samplesTraced > 0);
  if (!isOtherMesh && in.view == view_ && picture == options_) return;
  view_ = in.view;
  options_ = picture;
  plain_ = smooth_ = {};
  shown_ = nullptr;
}

std::shared_ptr<RadianceImage> BouncedPicture::addTo(const FrameInputs& in,
                                                     const std::shared_ptr<RadianceImage>& picture,
                                                     int antialias, bool& gbufferIsCurrent) {
  if (shown_ && picture == under_ && antialias == antialias_) return shown_;
  SurfacePicture& pixels = antialias > 1 ? smooth_ : plain_;
  if (pixels.samples() != antialias) {
    pixels.restart(view_.width, view_.height, antialias);
    for (int i = 0; i < antialias; ++i) {
      if (antialias > 1 || !gbufferIsCurrent)
        in.backend.renderGBuffer(view_, antialias > 1 ? pixelJitter(i, antialias) : vec2(0.0f));
      gbufferIsCurrent = antialias == 1;
      pixels.add(in.scene, in.services.rays(), light_.mesh(), light_.cuts(),
                 in.backend.hostGBuffer(), view_.eye, options_);
    }
  }
  Image sum = picture->pixels();
  pixels.addTo(light_.values(), sum);
  under_ = picture;
  antialias_ = antialias;
  shown_ = std::make_shared<HostImage>(std::move(sum));
  return shown_;
}

}  // namespace lamplighter
