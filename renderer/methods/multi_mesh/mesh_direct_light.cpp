#include "renderer/methods/multi_mesh/mesh_direct_light.h"

#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/methods/pixel_jitter.h"

namespace lamplighter {

// Returns whether the picture without a shift must be computed again.
bool MeshDirectLight::takeScene(const FrameInputs& in, const DirectMeshOptions& options,
                                const SurfacePictureOptions& surfaces) {
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  const bool isOther = !isStarted_ || options != options_;
  isStarted_ = true;
  options_ = options;
  bool hasOtherLight = false;
  if (isOther || !changes.none()) {
    shown_ = nullptr;
    lights_ = LightSet(in.scene, lights_);
    meshes_.update(in.scene, changes, in.services.rays(), lights_, options);
    hasOtherLight = meshes_.changed();
  }
  const bool isSamePicture = !isOther && in.view == view_ && surfaces == surfaces_;
  view_ = in.view;
  surfaces_ = surfaces;
  return !isSamePicture || hasOtherLight;
}

void MeshDirectLight::show(const FrameInputs& in, int sample, int antialias,
                           bool& gbufferIsCurrent) {
  if (shownSample_ == sample) return;
  const bool isShifted = sample != kUnshifted;
  if (isShifted || !gbufferIsCurrent)
    in.backend.renderGBuffer(view_, isShifted ? pixelJitter(sample, antialias) : vec2(0.0f));
  gbufferIsCurrent = !isShifted;
  meshes_.show(view_, in.backend.hostGBuffer(), surfaces_);
  shownSample_ = sample;
}

void MeshDirectLight::addSample(int antialias) {
  meshes_.picture(sample_);
  if (averaged_ == 0)
    smooth_ = ByMesh(sample_.size(),
                     std::vector<vec3>(sample_.empty() ? 0 : sample_[0].size(), vec3(0.0f)));
  const float weight = 1.0f / static_cast<float>(antialias);
  for (size_t m = 0; m < sample_.size(); ++m)
    for (size_t i = 0; i < sample_[m].size(); ++i) smooth_[m][i] += weight * sample_[m][i];
  ++averaged_;
}

std::shared_ptr<RadianceImage> MeshDirectLight::addTo(const FrameInputs& in,
                                                      const std::shared_ptr<RadianceImage>& picture,
                                                      int antialias,
                                                      const DirectMeshOptions& options,
                                                      const SurfacePictureOptions& surfaces,
                                                      size_t samples, bool& gbufferIsCurrent) {
  meshes_.beginFrame();
  if (takeScene(in, options, surfaces)) {
    isComplete_ = false;
    shownSample_ = kNothing;
  }
  if (!isComplete_ || antialias != antialias_) averaged_ = 0;
  antialias_ = antialias;
  if (!isComplete_) {
    show(in, kUnshifted, antialias, gbufferIsCurrent);
    isComplete_ = meshes_.goOn(samples);
    meshes_.picture(plain_);
    shown_ = nullptr;
  } else if (antialias > 1 && averaged_ < antialias) {
    show(in, averaged_, antialias, gbufferIsCurrent);
    if (meshes_.goOn(samples)) addSample(antialias);
  }
  const bool isSmooth = antialias > 1 && averaged_ == antialias;
  if (shown_ && picture == under_ && isSmooth == shownIsSmooth_) return shown_;
  Image sum = picture->pixels();
  const ByMesh& parts = isSmooth ? smooth_ : plain_;
  const std::vector<vec3> brightness = meshes_.brightness();
  tbb::parallel_for(0, sum.height, [&](int y) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(sum.width);
    for (size_t i = first; i < first + static_cast<size_t>(sum.width); ++i)
      for (size_t m = 0; m < parts.size(); ++m) sum.pixels[i] += brightness[m] * parts[m][i];
  });
  under_ = picture;
  shownIsSmooth_ = isSmooth;
  shown_ = std::make_shared<HostImage>(std::move(sum));
  return shown_;
}

}  // namespace lamplighter
