// Light of a light field, added to a picture.
#pragma once

#include "renderer/light_field/light_field.h"
#include "renderer/methods/texel_picture.h"

namespace lamplighter {

class FieldPicture : public TexelPicture<LightField> {
 public:
  // Continues the computation. `pace`: share of the usual work of a frame.
  void update(const FrameInputs& in, const LightFieldOptions& options, float pace);
  // Estimate of the frames until isDone(), without further changes.
  int framesLeft(int antialias) const;
  // Views of the field (field_views.h) by name, after outdate(). They keep references to this
  // object.
  std::map<std::string, std::function<ViewPicture()>> views() const;
  void forget() { *this = FieldPicture(); }

 private:
  uint64_t mostWork_ = 1;  // work limit of the last frame
};

}  // namespace lamplighter
