// The bounced light of a picture, from light on surfaces. Each frame shows all of it, at first with
// the noise of few rays.
#pragma once

#include <memory>

#include "renderer/methods/gi_method.h"
#include "renderer/surface_light/pixels/resting_picture.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

class BouncedPicture {
 public:
  // Call with the changes of each frame, also in frames that do not show the light.
  void outdate(const RenderSceneChanges& changes) { unseen_.merge(changes); }
  // Continues the computation of the light by a limited number of rays. `pace`: share of that
  // number, up to 1, in a frame in which anything changes.
  void update(const FrameInputs& in, const SurfaceLightOptions& light,
              const SurfacePictureOptions& picture, float pace = 1.0f);
  // The `pace` of the last update.
  float pace() const { return pace_; }

  // Returns `picture` plus bounced light: the mean of `antialias` pictures with subpixel shifts (1:
  // no shift). Each frame adds some rows; until all are complete, the result has no shift.
  // `gbufferIsCurrent`: whether the backend has the G-buffer of the view without a shift; updated
  // by the call.
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture, int antialias,
                                       bool& gbufferIsCurrent);
  // Whether all rays of the light are traced, and a mean of `antialias` shifted pictures is
  // complete.
  bool isDone(int antialias) const {
    return light_.isDone() && records_.isDone() &&
           (antialias <= 1 ? still_.isComplete() : isSmooth(antialias));
  }
  // Estimate of the frames until isDone(), without further changes. It counts each sample as one
  // frame, though those of a large picture take several: RepairedMethod uses this number to decide
  // whether to trace paths before the picture has settled; these take longer in a large picture,
  // too.
  int framesLeft(int antialias) const;
  // For debug views. Null without light. Valid until the next update.
  std::shared_ptr<const ElementView> elements() const;
  // For Inspection::links: the light of elements. Null without bounced light. Valid until the next
  // update.
  InspectedLinks links() const;
  // For GiOutput::surfaces. Null without bounced light. Keeps references to this object and `in`.
  std::shared_ptr<const MirroredLight> surfaces(const FrameInputs& in) const;
  const SurfaceLight::Counts& counts() const { return light_.counts(); }
  size_t pictureBytes() const {
    return records_.bytes() + moving_.bytes() + still_.bytes() + smooth_.bytes();
  }
  void forget() { *this = BouncedPicture(); }

 private:
  GatherScene gatherScene(const FrameInputs& in) const {
    return {in.scene, in.services.rays(), light_.mesh(), light_.cuts()};
  }
  void showView(const FrameInputs& in, bool& gbufferIsCurrent);
  void updateRecords(const FrameInputs& in, bool& gbufferIsCurrent);
  bool isSmooth(int antialias) const {
    return antialias > 1 && smooth_.samples() == antialias && smooth_.isComplete();
  }
  void forgetPixels();
  void goOn(const FrameInputs& in, RestingPicture& picture, int samples, bool& gbufferIsCurrent);
  void drawMoving(const FrameInputs& in, bool& gbufferIsCurrent);

  SurfaceLight light_;
  const RenderScene* scene_ = nullptr;  // of the last update
  RenderSceneChanges unseen_;           // since the last update
  SurfacePictureOptions options_;
  View view_;
  ViewRecords records_;
  bool recordsAreOutdated_ = true;  // anything except the light of the mesh changed
  bool isAtRest_ = false, hasOtherLight_ = false, keepsPixels_ = false;  // of this frame
  uint64_t raysLeft_ = 0;                                                // of this frame
  float pace_ = 1.0f;                                                    // of this frame
  uint32_t seed_ = 0;
  GatherProjection projection_ = GatherProjection::hemisphere;
  SurfacePicture moving_;          // with uniform light instead of glossy reflections
  RestingPicture still_, smooth_;  // without a shift; antialiased
  // The picture that was shown last.
  std::shared_ptr<RadianceImage> under_, shown_;
  int shownOf_ = 0;  // samples; 0: moving_
};

}  // namespace lamplighter
