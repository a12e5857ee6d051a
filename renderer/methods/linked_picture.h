// Bounced light along links of texels, added to a picture.
#pragma once

#include "renderer/methods/atlas_picture.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

class LinkedPicture {
 public:
  // To be called with each frame, also with those that do not show the light.
  void outdate(const FrameInputs& in) {
    scene_ = &in.scene;
    rays_ = &in.services.rays();
    light_.outdate(in.changes);
    picture_.outdate(in);
  }
  // Goes on. `pace`: share of the usual work of a frame.
  void update(const FrameInputs& in, const TexelRadiosityOptions& options, float pace);
  // `picture` plus the bounced light; see AtlasPicture::addTo().
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture, int antialias,
                                       const SurfacePictureOptions& options, uint32_t seed,
                                       bool& gbufferIsCurrent) {
    return picture_.addTo(in, picture, light_, antialias, options, seed, gbufferIsCurrent);
  }
  bool isDone(int antialias) const { return light_.isDone() && picture_.isDone(antialias); }
  int framesLeft(int antialias) const {
    return light_.isDone() ? picture_.framesLeft(antialias) : antialias + 1;
  }
  const TexelRadiosity& light() const { return light_; }
  // By name: views of texels (texel_views.h), after outdate(). They refer to this object.
  std::map<std::string, std::function<ViewPicture()>> views() const;
  // Inspection::links. Null before update(). It refers to this object.
  InspectedLinks links() const;
  void forget() { *this = LinkedPicture(); }

 private:
  TexelRadiosity light_;
  AtlasPicture picture_;
  // Of this frame.
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
  bool isUsed_ = false;  // since forget()
};

}  // namespace lamplighter
