#include "renderer/methods/linked_picture.h"

#include <algorithm>
#include <cmath>

#include "renderer/methods/texel_views.h"

namespace lamplighter {
namespace {

// Maximum number of rays per frame: about 50 ms on two cores.
constexpr float kLinkRaysAFrame = 300'000.0f;
constexpr float kMostPace = 8.0f;

}  // namespace

void LinkedPicture::update(const FrameInputs& in, const TexelRadiosityOptions& options,
                           float pace) {
  isUsed_ = true;
  light_.update(in.scene, in.services, options,
                static_cast<uint64_t>(kLinkRaysAFrame * std::min(pace, kMostPace)) + 1);
}

std::map<std::string, std::function<ViewPicture()>> LinkedPicture::views() const {
  std::map<std::string, std::function<ViewPicture()>> out;
  if (scene_ == nullptr) return out;
  for (const MethodView& view : texelViews())
    out[view.name] = [this, name = view.name] {
      return drawTexelView(name, {picture_, light_, *scene_, *rays_});
    };
  return out;
}

InspectedLinks LinkedPicture::links() const {
  if (!isUsed_) return nullptr;
  return [this](const InspectedPlace& place) -> std::optional<std::vector<InspectedLink>> {
    const auto senders = light_.sendersTo(*scene_, *rays_, place.object, place.triangle,
                                          place.isBack, place.position);
    if (!senders) return std::nullopt;
    std::vector<InspectedLink> out;
    for (const TexelSender& s : *senders)
      out.push_back({place.position, s.centre, s.object, s.irradiance, std::sqrt(s.area)});
    return out;
  };
}

}  // namespace lamplighter
