// Light of a light field, added to a picture.
#pragma once

#include "renderer/light_field/light_field.h"
#include "renderer/methods/atlas_picture.h"

namespace lamplighter {

class FieldPicture {
 public:
  // To be called with each frame, also with those that do not show the light.
  void outdate(const FrameInputs& in) {
    scene_ = &in.scene;
    rays_ = &in.services.rays();
    light_.outdate(in.changes);
    picture_.outdate(in);
  }
  // Goes on. `pace`: share of the usual work of a frame.
  void update(const FrameInputs& in, const LightFieldOptions& options, float pace);
  // `picture` plus the light; see AtlasPicture::addTo().
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture, int antialias,
                                       const SurfacePictureOptions& options, uint32_t seed,
                                       bool& gbufferIsCurrent) {
    return picture_.addTo(in, picture, light_, antialias, options, seed, gbufferIsCurrent);
  }
  bool isDone(int antialias) const { return light_.isDone() && picture_.isDone(antialias); }
  // Estimate of the frames until isDone(), without further changes.
  int framesLeft(int antialias) const;
  const LightField& light() const { return light_; }
  // By name: views of the field (field_views.h), after outdate(). They refer to this object.
  std::map<std::string, std::function<ViewPicture()>> views() const;
  void forget() { *this = FieldPicture(); }

 private:
  LightField light_;
  AtlasPicture picture_;
  uint64_t mostWork_ = 1;  // of the last frame
  // Of this frame.
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
};

}  // namespace lamplighter
