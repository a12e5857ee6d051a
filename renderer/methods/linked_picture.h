// Bounced light along links of texels, added to a picture.
#pragma once

#include "renderer/methods/texel_picture.h"
#include "renderer/surface_depths/texel_radiosity.h"

namespace lamplighter {

class LinkedPicture : public TexelPicture<TexelRadiosity> {
 public:
  // Continues the computation. `pace`: share of the usual work of a frame.
  void update(const FrameInputs& in, const TexelRadiosityOptions& options, float pace);
  int framesLeft(int antialias) const {
    return light_.isDone() ? picture_.framesLeft(antialias) : antialias + 1;
  }
  // Views of texels (texel_views.h) by name, after outdate(). They keep references to this object.
  std::map<std::string, std::function<ViewPicture()>> views() const;
  // For Inspection::links. Null before update(). Keeps a reference to this object.
  InspectedLinks links() const;
  void forget() { *this = LinkedPicture(); }

 private:
  bool isUsed_ = false;  // since forget()
};

}  // namespace lamplighter
