#include "renderer/methods/linked_picture.h"

#include <algorithm>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// Rays of a frame: some 50 ms on two cores.
constexpr float kRaysAFrame = 300'000.0f;
constexpr float kMostPace = 8.0f;
// White in the view of links.
constexpr float kManyLinks = 1000.0f;

constexpr char kTexelsView[] = "atlas_texels", kLinksView[] = "texel_links";

// Each texel by a number from 0 to 1.
template <typename Number>
ViewPicture drawn(const AtlasPicture& picture, const Number& numberOf) {
  ViewPicture out;
  out.image = Image8(picture.view().width, picture.view().height);
  const std::vector<uint32_t> texels = picture.texels();
  for (size_t i = 0; i < texels.size(); ++i)
    if (texels[i] != TexelSet::kNone)
      std::fill_n(&out.image.pixels[4 * i], 3,
                  static_cast<uint8_t>(255.0f * std::clamp(numberOf(texels[i]), 0.0f, 1.0f)));
  return out;
}

}  // namespace

void LinkedPicture::update(const FrameInputs& in, const TexelRadiosityOptions& options,
                           float pace) {
  light_.update(in.scene, in.services, options,
                static_cast<uint64_t>(kRaysAFrame * std::min(pace, kMostPace)) + 1);
}

std::map<std::string, std::function<ViewPicture()>> LinkedPicture::views() const {
  std::map<std::string, std::function<ViewPicture()>> out;
  out[kTexelsView] = [this] {
    ViewPicture view = drawn(picture_, [](uint32_t t) {
      return static_cast<float>(hash4(t, 0, 0, 0x7e) % 1000u) / 1000.0f;
    });
    view.legend.title = "Texels";
    return view;
  };
  out[kLinksView] = [this] {
    ViewPicture view = drawn(picture_, [&](uint32_t t) {
      return light_.links().isDone() && t < light_.texels().size()
                 ? static_cast<float>(light_.links().of(t).size()) / kManyLinks
                 : 0.0f;
    });
    view.legend.title = "Links of a texel";
    view.legend.ramp = {vec3(0.0f), vec3(1.0f)};
    view.legend.low = "0";
    view.legend.high = std::to_string(static_cast<int>(kManyLinks));
    return view;
  };
  return out;
}

const std::vector<MethodView>& linkedViews() {
  static const std::vector<MethodView> views{
      {kTexelsView, "Texels of the atlas",
       "The texels that keep bounced light, each in another shade."},
      {kLinksView, "Links of texels", "The number of links by which each texel receives light."}};
  return views;
}

}  // namespace lamplighter
