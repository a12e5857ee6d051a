#include "renderer/methods/texel_views.h"

#include <algorithm>
#include <functional>
#include <iterator>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/surface_depths/texel_sight.h"

namespace lamplighter {
namespace {

// Number of links that is shown as white.
constexpr float kManyLinks = 1000.0f;
// Number of segments per pixel of the depth maps that is shown as white.
constexpr float kManySegments = 0.25f;
// Share of errors that is shown as white; rays per texel that find them.
constexpr float kLargeError = 0.25f;
constexpr size_t kErrorRays = 32;

// Display colours.
constexpr vec3 kFound{0.25f, 0.33f, 0.40f}, kHalfFound{0.95f, 0.78f, 0.26f},
    kMissing{0.80f, 0.27f, 0.24f};

// Draws each texel in a colour.
template <typename ColourOf>
ViewPicture drawn(const TexelViewSubject& in, const ColourOf& colourOf) {
  ViewPicture out;
  out.image = Image8(in.picture.view().width, in.picture.view().height);
  const std::vector<uint32_t> texels = in.picture.texels();
  for (size_t i = 0; i < texels.size(); ++i) {
    if (texels[i] >= in.light.texels().size()) continue;
    const vec3 colour = glm::clamp(colourOf(texels[i]), 0.0f, 1.0f);
    for (int c = 0; c < 3; ++c)
      out.image.pixels[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(255.0f * colour[c]);
  }
  return out;
}

void addRamp(ViewPicture& view, const char* title, const std::string& high) {
  view.legend.title = title;
  view.legend.ramp = {vec3(0.0f), vec3(1.0f)};
  view.legend.low = "0";
  view.legend.high = high;
}

std::string percent(float share) {
  return std::to_string(static_cast<int>(100.0f * share + 0.5f)) + "%";
}

// The reason why there are no depths; "": they are known or will be computed.
std::string problemOfDepths(const TexelViewSubject& in) {
  const bool isMissing = in.light.isDone() && !in.light.depths().isDone();
  return isMissing ? "it needs link_visibility=stored" : "";
}

ViewPicture texels(const TexelViewSubject& in) {
  ViewPicture view = drawn(in, [](uint32_t t) {
    return vec3(static_cast<float>(hash4(t, 0, 0, 0x7e) % 1000u) / 1000.0f);
  });
  view.legend.title = "Texels";
  return view;
}

ViewPicture linkCounts(const TexelViewSubject& in) {
  const TexelLinks& links = in.light.links();
  ViewPicture view = drawn(in, [&](uint32_t t) {
    return vec3(links.isDone() ? static_cast<float>(links.of(t).size()) / kManyLinks : 0.0f);
  });
  addRamp(view, "Links of a texel", std::to_string(static_cast<int>(kManyLinks)));
  return view;
}

ViewPicture segments(const TexelViewSubject& in) {
  ViewPicture view = drawn(
      in, [&](uint32_t t) { return vec3(in.light.depths().segmentShareOf(t) / kManySegments); });
  addRamp(view, "Stored depths per pixel of depth maps", percent(kManySegments));
  view.problem = problemOfDepths(in);
  return view;
}

// Traces rays for the visible texels.
ViewPicture queryErrors(const TexelViewSubject& in) {
  std::vector<float> errors(in.light.texels().size());
  const SurfaceDepths& depths = in.light.depths();
  if (depths.isDone()) {
    std::vector<uint32_t> visible = in.picture.texels();
    std::ranges::sort(visible);
    const auto twice = std::ranges::unique(visible);
    visible.erase(twice.begin(), twice.end());
    std::erase_if(visible, [&](uint32_t t) { return t >= errors.size(); });
    tbb::parallel_for(size_t{0}, visible.size(), [&](size_t i) {
      errors[visible[i]] =
          queryErrorOf(visible[i], in.scene, in.rays, in.light.texels(), in.light.tree(), depths,
                       in.light.options().linkError, kErrorRays);
    });
  }
  ViewPicture view = drawn(in, [&](uint32_t t) { return vec3(errors[t] / kLargeError); });
  addRamp(view, "Look-ups that differ from rays", percent(kLargeError));
  view.problem = problemOfDepths(in);
  return view;
}

ViewPicture pendingLinks(const TexelViewSubject& in) {
  ViewPicture view = drawn(in, [&](uint32_t t) {
    if (t < in.light.links().found()) return kFound;
    return in.light.depths().isFound(t) ? kHalfFound : kMissing;
  });
  view.legend.title = "Links of a texel";
  view.legend.swatches = {
      {kFound, "found"}, {kHalfFound, "depths are found"}, {kMissing, "to be found"}};
  return view;
}

struct TexelDrawing {
  MethodView view;
  ViewPicture (*draw)(const TexelViewSubject& in);
};

const std::vector<TexelDrawing>& drawings() {
  static const std::vector<TexelDrawing> all{
      {{"atlas_texels", "Texels of the atlas",
        "The texels that store bounced light, each in a different shade."},
       texels},
      {{"texel_links", "Links of texels",
        "The number of links by which each texel receives light."},
       linkCounts},
      {{"pending_links", "Pending links",
        "Texels whose links are not computed yet: they show their previous light."},
       pendingLinks},
      {{"depth_segments", "Segments of depths",
        "Number of depths that are stored for each run of texels, as a share of the pixels of its "
        "depth maps: bright where depths compress badly."},
       segments},
      {{"query_error", "Errors of stored depths",
        "Share of visibility tests for links in which the stored depths of a texel disagree with "
        "rays."},
       queryErrors}};
  return all;
}

}  // namespace

const std::vector<MethodView>& texelViews() {
  static const std::vector<MethodView> views = [] {
    std::vector<MethodView> all;
    std::ranges::transform(drawings(), std::back_inserter(all), &TexelDrawing::view);
    return all;
  }();
  return views;
}

ViewPicture drawTexelView(std::string_view name, const TexelViewSubject& in) {
  return std::ranges::find(drawings(), name,
                           [](const TexelDrawing& d) { return std::string_view(d.view.name); })
      ->draw(in);
}

}  // namespace lamplighter
