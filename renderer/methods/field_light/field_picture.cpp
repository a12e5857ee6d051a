#include "renderer/methods/field_light/field_picture.h"

#include <algorithm>
#include <cmath>

#include "renderer/methods/field_light/field_views.h"

namespace lamplighter {
namespace {

// Work per frame: about 40 ms on two cores.
constexpr float kFieldWorkAFrame = 4'000'000.0f;
constexpr float kMostFieldPace = 8.0f;

}  // namespace

void FieldPicture::update(const FrameInputs& in, const LightFieldOptions& options, float pace) {
  mostWork_ = static_cast<uint64_t>(kFieldWorkAFrame * std::min(pace, kMostFieldPace)) + 1;
  light_.update(in.scene, in.services, options, mostWork_);
}

int FieldPicture::framesLeft(int antialias) const {
  if (light_.isDone()) return picture_.framesLeft(antialias);
  const auto left = static_cast<double>(light_.samplesLeft());
  return static_cast<int>(std::ceil(left / static_cast<double>(mostWork_))) + antialias + 1;
}

std::map<std::string, std::function<ViewPicture()>> FieldPicture::views() const {
  std::map<std::string, std::function<ViewPicture()>> out;
  if (scene_ == nullptr) return out;
  for (const MethodView& view : fieldViews())
    out[view.name] = [this, name = view.name] {
      return drawFieldView(name, {picture_, light_, *scene_, *rays_});
    };
  return out;
}

}  // namespace lamplighter
