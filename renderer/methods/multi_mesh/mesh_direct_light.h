// The direct light of a picture, from meshes that are refined for its view.
#pragma once

#include <memory>

#include "renderer/methods/gi_method.h"
#include "renderer/surface_light/direct_meshes/direct_meshes.h"

namespace lamplighter {

class MeshDirectLight {
 public:
  // Call with the changes of each frame, also in frames that do not show the light.
  void outdate(const RenderSceneChanges& changes) { unseen_.merge(changes); }
  // Returns `picture` plus the direct light of emissive surfaces. Each call computes the light of
  // about `samples` more vertices; when none is missing, the result is the mean of `antialias`
  // pictures with subpixel shifts, one more per frame. `gbufferIsCurrent`: whether the backend has
  // the G-buffer of the view without a shift; updated by the call.
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture, int antialias,
                                       const DirectMeshOptions& options,
                                       const SurfacePictureOptions& surfaces, size_t samples,
                                       bool& gbufferIsCurrent);
  // Whether a mean of `antialias` shifted pictures is complete.
  bool isDone(int antialias) const {
    return isComplete_ && (antialias <= 1 || averaged_ == antialias);
  }
  int framesLeft(int antialias) const {
    return isComplete_ ? antialias - averaged_ : antialias + 1;
  }
  const DirectMeshes::Counts& counts() const { return meshes_.counts(); }
  void forget() { *this = MeshDirectLight(); }

 private:
  using ByMesh = std::vector<std::vector<vec3>>;  // radiance by mesh and pixel, per brightness
  bool takeScene(const FrameInputs& in, const DirectMeshOptions& options,
                 const SurfacePictureOptions& surfaces);
  void show(const FrameInputs& in, int sample, int antialias, bool& gbufferIsCurrent);
  void addSample(int antialias);

  static constexpr int kNothing = -2, kUnshifted = -1;
  LightSet lights_;
  DirectMeshes meshes_;
  RenderSceneChanges unseen_;
  DirectMeshOptions options_;
  SurfacePictureOptions surfaces_;
  View view_;
  bool isStarted_ = false, isComplete_ = false;  // isComplete_: the picture without a shift
  int shownSample_ = kNothing;                   // sample whose pixels the meshes have
  ByMesh plain_, smooth_, sample_;
  int averaged_ = 0, antialias_ = 0;  // samples in smooth_; their total number
  // The picture that was shown last.
  std::shared_ptr<RadianceImage> under_, shown_;
  bool shownIsSmooth_ = false;
};

}  // namespace lamplighter
