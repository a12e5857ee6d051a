// Adds light that is stored at texels to a picture: common code of LinkedPicture and FieldPicture.
#pragma once

#include "renderer/methods/atlas_picture.h"
#include "renderer/methods/texel_mirror.h"

namespace lamplighter {

// `Light`: a TexelIrradiance with a function outdate() for the changes of each frame.
template <typename Light>
class TexelPicture {
 public:
  // Call in each frame, also in frames that do not show the light.
  void outdate(const FrameInputs& in) {
    scene_ = &in.scene;
    rays_ = &in.services.rays();
    light_.outdate(in.changes);
    picture_.outdate(in);
  }
  // Returns `picture` plus the light; see AtlasPicture::addTo().
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in,
                                       const std::shared_ptr<RadianceImage>& picture, int antialias,
                                       const SurfacePictureOptions& options, uint32_t seed,
                                       bool& gbufferIsCurrent) {
    return picture_.addTo(in, picture, light_, antialias, options, seed, gbufferIsCurrent);
  }
  bool isDone(int antialias) const { return light_.isDone() && picture_.isDone(antialias); }
  const Light& light() const { return light_; }
  // For GiOutput::surfaces. Keeps references to this object and `in`.
  std::shared_ptr<const MirroredLight> surfaces(const FrameInputs& in) const {
    if (light_.reflected().empty()) return nullptr;
    return std::make_shared<TexelMirror>(in.scene, in.services.rays(), light_);
  }

 protected:
  Light light_;
  AtlasPicture picture_;
  // State of this frame.
  const RenderScene* scene_ = nullptr;
  const RayCaster* rays_ = nullptr;
};

}  // namespace lamplighter
