#include "renderer/methods/atlas_picture.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/pixel_jitter.h"
#include "renderer/methods/texel_mirror.h"
#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {

AtlasPicture::Sample AtlasPicture::sampleOf(const FrameInputs& in, const TexelIrradiance& light,
                                            const SurfacePictureOptions& options,
                                            const Sample& before,
                                            std::span<const uint32_t> movedObjects,
                                            bool withoutLobes) const {
  const GBufferView gbuffer = in.backend.hostGBuffer();
  const RayCaster& rays = in.services.rays();
  Sample sample(static_cast<size_t>(view_.width) * static_cast<size_t>(view_.height));
  tbb::parallel_for(0, view_.height, [&](int y) {
    for (int x = 0; x < view_.width; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const size_t i =
          static_cast<size_t>(y) * static_cast<size_t>(view_.width) + static_cast<size_t>(x);
      Pixel& out = sample[i];
      const bool isSame = i < before.size() && before[i].object == p.object &&
                          before[i].triangle == p.triangle && before[i].position == p.position &&
                          std::ranges::find(movedObjects, p.object) == movedObjects.end();
      out.position = p.position;
      out.object = p.object;
      out.triangle = p.triangle;
      const SeenTriangle seen(in.scene, p);
      if (!seen.isSound) continue;
      out.blend =
          isSame ? before[i].blend
                 : light.blendAt(in.scene, rays, p.object, p.triangle, seen.isBack, p.position);
      if (!out.blend.isAny()) continue;
      const PixelReflectance r = reflectanceOf(in.scene, p, seen.weights, view_.eye, options);
      const float even = withoutLobes ? 1.0f - PixelLobes::tracedShare(r.roughness) : 1.0f;
      out.reflectance = r.diffuse + even * r.lobe;
    }
  });
  return sample;
}

void AtlasPicture::outdate(const FrameInputs& in) {
  unseen_.merge(in.changes);
  if (in.view == view_) return;
  view_ = in.view;
  samples_.clear();
}

std::vector<uint32_t> AtlasPicture::texels() const {
  std::vector<uint32_t> out;
  if (samples_.empty()) return out;
  for (const Pixel& p : samples_.front()) {
    const auto largest = std::ranges::max_element(p.blend.weights) - p.blend.weights.begin();
    const auto k = static_cast<size_t>(largest);
    out.push_back(p.blend.weights[k] > 0.0f ? p.blend.texels[k] : TexelSet::kNone);
  }
  return out;
}

void AtlasPicture::showView(const FrameInputs& in, bool& gbufferIsCurrent) {
  if (!gbufferIsCurrent) in.backend.renderGBuffer(view_, vec2(0.0f));
  gbufferIsCurrent = true;
}

std::shared_ptr<RadianceImage> AtlasPicture::addTo(const FrameInputs& in,
                                                   const std::shared_ptr<RadianceImage>& picture,
                                                   const TexelIrradiance& light, int antialias,
                                                   const SurfacePictureOptions& options,
                                                   uint32_t seed, bool& gbufferIsCurrent) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  const TexelMirror mirror(in.scene, in.services.rays(), light);
  Sample before;
  if (changes.rebuilt || changes.materials || changes.objects || options != options_ ||
      light.texelVersion() != texelVersion_) {
    samples_.clear();
  } else if (!changes.movedObjects.empty()) {
    if (!samples_.empty()) before = std::move(samples_.front());
    samples_.clear();
  }
  texelVersion_ = light.texelVersion();
  options_ = options;
  if (antialias > 1 && antialias != antialias_) {
    antialias_ = antialias;
    samples_.resize(std::min<size_t>(samples_.size(), 1));
  }
  if (samples_.empty()) {
    showView(in, gbufferIsCurrent);
    samples_.push_back(sampleOf(in, light, options, before, changes.movedObjects, false));
    plainLobes_ = {};
    hasPlainLobes_ = false;
    shown_ = nullptr;
  } else if (!hasPlainLobes_ && changes.none() && samples_.size() == 1) {
    // Only in frames without a change: during a motion these rays would be traced again each time.
    showView(in, gbufferIsCurrent);
    samples_.front() = sampleOf(in, light, options, samples_.front(), {}, true);
    plainLobes_.restart(view_, 1, seed);
    plainLobes_.add(in.scene, in.services.rays(), mirror, in.backend.hostGBuffer(), options,
                    {0, view_.height});
    hasPlainLobes_ = true;
    shown_ = nullptr;
  } else if (light.isDone() && antialias > 1 && static_cast<int>(samples_.size()) <= antialias) {
    in.backend.renderGBuffer(view_, pixelJitter(static_cast<int>(samples_.size()) - 1, antialias));
    gbufferIsCurrent = false;
    if (samples_.size() == 1) lobes_.restart(view_, antialias, seed);
    samples_.push_back(sampleOf(in, light, options, {}, {}, true));
    lobes_.add(in.scene, in.services.rays(), mirror, in.backend.hostGBuffer(), options,
               {0, view_.height});
  }
  // The shifted pictures, once all exist.
  const bool isSmooth =
      changes.none() && antialias > 1 && static_cast<int>(samples_.size()) == antialias + 1;
  const std::span<const Sample> parts =
      isSmooth ? std::span(samples_).subspan(1) : std::span(samples_).first(1);
  const auto shownOf = static_cast<int>(parts.size());
  if (light.irradiance().empty()) {
    shownOf_ = shownOf;
    shown_ = nullptr;
    return picture;
  }
  if (shown_ && picture == under_ && shownOf == shownOf_ && version_ == light.version())
    return shown_;
  if (version_ != light.version()) {
    plainLobes_.outdateLight();
    lobes_.outdateLight();
  }
  version_ = light.version();
  Image sum = picture->pixels();
  const float scale = 1.0f / (kPi * static_cast<float>(parts.size()));
  const std::vector<vec3>& irradiance = light.irradiance();
  tbb::parallel_for(0, sum.height, [&](int y) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(sum.width);
    for (size_t i = first; i < first + static_cast<size_t>(sum.width); ++i) {
      for (const Sample& part : parts) {
        const Pixel& p = part[i];
        vec3 here(0.0f);
        for (size_t k = 0; k < 4; ++k)
          if (p.blend.weights[k] > 0.0f) here += p.blend.weights[k] * irradiance[p.blend.texels[k]];
        sum.pixels[i] += scale * p.reflectance * here;
      }
    }
  });
  (isSmooth ? lobes_ : plainLobes_).addTo(in.scene, mirror, sum);
  under_ = picture;
  shownOf_ = shownOf;
  shown_ = std::make_shared<HostImage>(std::move(sum));
  return shown_;
}

}  // namespace lamplighter
