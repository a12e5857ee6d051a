// Light of texels at the pixels of a view.
#pragma once

#include <memory>
#include <vector>

#include "renderer/methods/gi_method.h"
#include "renderer/surface_light/pixels/pixel_lobes.h"
#include "renderer/texels/texel_irradiance.h"

namespace lamplighter {

class AtlasPicture {
 public:
  // Call in each frame.
  void outdate(const FrameInputs& in);
  // Returns `picture` plus the bounced light. When the light is complete: the mean of `antialias`
  // pictures with subpixel shifts, one more in each frame. `gbufferIsCurrent`: whether the backend
  // has the G-buffer of the view without a shift; updated by the call.
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture,
                                       const TexelIrradiance& light, int antialias,
                                       const SurfacePictureOptions& options, uint32_t seed,
                                       bool& gbufferIsCurrent);
  // Whether the last picture is the mean of all shifted pictures.
  bool isDone(int antialias) const {
    return framesLeft(antialias) == 0 && (antialias <= 1 || shownOf_ == antialias);
  }
  int framesLeft(int antialias) const {
    if (antialias <= 1) return hasPlainLobes_ ? 0 : 1;
    return antialias + 1 - static_cast<int>(samples_.size());
  }
  void forget() { *this = AtlasPicture(); }
  const View& view() const { return view_; }
  // For views: the texel with the largest share of each pixel of the picture without a shift, or
  // TexelSet::kNone.
  std::vector<uint32_t> texels() const;

 private:
  struct Pixel {
    vec3 position{0.0f};  // point that the pixel shows (world space), and its triangle
    uint32_t object = TexelSet::kNone, triangle = 0;
    TexelBlend blend;
    vec3 reflectance{0.0f};  // reflected share of uniform light, times π
  };
  using Sample = std::vector<Pixel>;
  // `before`: a previous sample, or empty: pixels that show the same point of an object that did
  // not move keep their texels. `withoutLobes`: leaves out the lobes, which PixelLobes adds.
  Sample sampleOf(const FrameInputs& in, const TexelIrradiance& light,
                  const SurfacePictureOptions& options, const Sample& before,
                  std::span<const uint32_t> movedObjects, bool withoutLobes) const;
  void showView(const FrameInputs& in, bool& gbufferIsCurrent);

  View view_;
  SurfacePictureOptions options_;
  uint32_t version_ = 0, texelVersion_ = 0;  // of the light
  RenderSceneChanges unseen_;
  std::vector<Sample> samples_;    // the first without a shift
  PixelLobes plainLobes_, lobes_;  // lobes of the first sample; of the others
  bool hasPlainLobes_ = false;     // otherwise the first sample uses uniform light instead of lobes
  std::shared_ptr<RadianceImage> under_, shown_;
  int shownOf_ = 0;    // samples
  int antialias_ = 0;  // number of shifts for which samples_ were made
};

}  // namespace lamplighter
