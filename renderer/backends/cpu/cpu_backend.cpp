#include "renderer/backends/cpu/cpu_backend.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/composition.h"

namespace lamplighter {
namespace cpu {
namespace {

// An image of f(index into the G-buffer) for each pixel.
template <typename F>
Image makeImage(const GBuffer& g, F&& f) {
  Image image(g.width, g.height);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) image.at(x, y) = f(g.index(x, y));
  });
  return image;
}

}  // namespace

void CpuBackend::takeScene(const RenderScene& scene, const RenderSceneChanges& changes,
                           const RayCaster& rays) {
  scene_ = &scene;
  rays_ = &rays;
  shiftedIsKnown_ = shiftedIsKnown_ && changes.none();
  if (changes.rebuilt || changes.materials) {
    stillIsKnown_ = false;
    return;
  }
  moves_.insert(moves_.end(), changes.movedBounds.begin(), changes.movedBounds.end());
  for (const uint32_t i : changes.movedObjects) moves_.push_back(scene.objects[i].bounds);
  for (const uint32_t i : changes.switchedObjects) moves_.push_back(scene.objects[i].bounds);
  // The G-buffer has the emission of surfaces.
  for (const RenderObject& o : scene.objects)
    if (std::binary_search(changes.emissions.begin(), changes.emissions.end(), o.material))
      moves_.push_back(o.bounds);
}

void CpuBackend::drawGBuffer(const View& view, vec2 jitter) {
  const bool isStill = jitter == vec2(0.0f);
  Picture& picture = isStill ? still_ : shifted_;
  shown_ = &picture;
  // Antialiasing that goes on after another stage rendered the unjittered picture.
  if (!isStill && shiftedIsKnown_ && view == picture.view && jitter == picture.jitter) return;
  if (isStill && stillIsKnown_ && view == stillView_) {
    rayCount_ += updateGBuffer(*scene_, *rays_, view, moves_, picture.gbuffer);
  } else {
    if (isStill) {
      seenIsKnown_ = stillIsKnown_ && moves_.empty() && view.width == stillView_.width &&
                     view.height == stillView_.height;
      if (seenIsKnown_) seen_.take(picture.gbuffer, stillView_);
      ++views_;
    }
    rayCount_ += cpu::renderGBuffer(*scene_, *rays_, view, jitter, picture.gbuffer);
  }
  picture.view = view;
  picture.jitter = jitter;
  if (!isStill) {
    shiftedIsKnown_ = true;
    return;
  }
  stillIsKnown_ = true;
  stillView_ = view;
  moves_.clear();
}

Background CpuBackend::background() const { return {scene_->sky, shown_->view, shown_->jitter}; }

std::shared_ptr<RadianceImage> CpuBackend::compose(const Image& irradiance, bool white) {
  const auto image = takeImage();
  cpu::compose(shown_->gbuffer, irradiance, background(), white, image->image);
  return image;
}

Image CpuBackend::readNormals() {
  const GBuffer& g = shown_->gbuffer;
  return makeImage(g, [&](size_t i) { return vec3(g.sx[i], g.sy[i], g.sz[i]); });
}

Image CpuBackend::readAlbedo() {
  const GBuffer& g = shown_->gbuffer;
  return makeImage(g, [&](size_t i) { return g.hit[i] ? g.albedo(i) : vec3(0.0f); });
}

}  // namespace cpu

std::unique_ptr<Backend> makeCpuBackend() {
  auto backend = std::make_unique<cpu::CpuBackend>();
  cpu::offerKernels(*backend);
  return backend;
}

}  // namespace lamplighter
