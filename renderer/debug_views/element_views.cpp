// Views of the elements of surface at whose corners light is kept.
#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"

namespace lamplighter::views {

namespace colours = view_colours;

namespace {

using Place = std::optional<ElementView::Place>;

// Where each pixel lies, by pixel.
std::vector<Place> placesOf(const ViewSubject& in, const Painter& p) {
  std::vector<Place> places(p.pixels());
  p.forEachPixel([&](int, int, size_t i) {
    const Hit& hit = p.hit(i);
    if (hit)
      places[i] = in.inspection.elements->placeAt(hit.object, hit.triangle, !p.seen(i).front,
                                                  {hit.u, hit.v});
  });
  return places;
}

// Paints colour(place, corners of its element) where there is an element.
template <typename Colour>
Image8 paintElements(const ViewSubject& in, const Colour& colour) {
  const Painter p(in);
  const std::vector<Place> places = placesOf(in, p);
  return p.paint([&](const Seen& s, size_t i) {
    if (!places[i]) return shaded(colours::kNoData, s);
    return shaded(colour(*places[i], in.inspection.elements->cornersOf(places[i]->element)), s);
  });
}

}  // namespace

ViewPicture meshEdges(const ViewSubject& in) {
  const Painter p(in);
  const std::vector<Place> places = placesOf(in, p);
  const auto width = static_cast<size_t>(in.view.width);
  const auto isOther = [&](size_t a, size_t b) {
    return places[a] && places[b] && places[a]->element != places[b]->element;
  };
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    if (!places[i]) return shaded(colours::kNoData, s);
    const auto element = static_cast<int>(places[i]->element);
    const vec3 hue = colours::ofPatch(s.hit->object, element);
    const vec3 colour =
        shaded(places[i]->isCluster ? glm::mix(vec3(luminance(hue)), hue, 0.25f) : hue, s);
    const bool isBorder = ((i + 1) % width != 0 && isOther(i, i + 1)) ||
                          (i + width < p.pixels() && isOther(i, i + width));
    return isBorder ? 0.45f * colour : colour;
  });
  return out;
}

ViewPicture meshSamples(const ViewSubject& in) {
  ViewPicture out;
  out.image = paintElements(in, [](const ElementView::Place& at, const auto& corners) {
    float buried = 0.0f;
    for (int c = 0; c < 3; ++c)
      if (corners[static_cast<size_t>(c)].isBuried) buried += at.weights[c];
    return glm::mix(glm::mix(colours::kPartial, colours::kNone, at.trust), colours::kFull, buried);
  });
  out.legend.title = "The light of pixels is that of";
  out.legend.swatches = {{colours::kNone, "elements"},
                         {colours::kPartial, "records at pixels"},
                         {colours::kFull, "neighbours: the corner is inside a wall"}};
  return out;
}

ViewPicture meshContrast(const ViewSubject& in) {
  ViewPicture out;
  out.image = paintElements(in, [](const ElementView::Place&, const auto& corners) {
    float least = luminance(corners[0].irradiance), most = least;
    for (const ElementView::Corner& c : corners) {
      least = std::min(least, luminance(c.irradiance));
      most = std::max(most, luminance(c.irradiance));
    }
    return colours::ramp(most > 0.0f ? (most - least) / (most + least) : 0.0f);
  });
  out.legend = {"Contrast of an element", {}, colours::rampSteps(), "0", "1"};
  return out;
}

ViewPicture meshAge(const ViewSubject& in) {
  constexpr float kFrom = 0.35f;  // of the ramp, so that little is not like nothing
  ViewPicture out;
  out.image = paintElements(in, [](const ElementView::Place& at, const auto& corners) {
    float pending = 0.0f;
    for (int c = 0; c < 3; ++c) pending += at.weights[c] * corners[static_cast<size_t>(c)].pending;
    return pending > 0.0f ? colours::ramp(glm::mix(kFrom, 1.0f, pending)) : colours::kSettled;
  });
  out.legend = {"Rays out of date or missing",
                {{colours::kSettled, "none"}},
                colours::rampSteps(kFrom),
                "few",
                "all"};
  return out;
}

}  // namespace lamplighter::views
