// Views of patch data: the patches themselves, and the visibility of lights on them.
#include <array>

#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::views {

namespace colours = view_colours;

ViewPicture patches(const ViewSubject& in) {
  Painter p(in);
  p.findPatches();
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    vec3 colour = colours::ofPatch(s.hit->object, p.patch(i));
    if (!p.shape(i).isPlanar) colour = glm::mix(vec3(luminance(colour)), colour, 0.25f);
    return outlined(p, s, i, shaded(colour, s));
  });
  return out;
}

ViewPicture patchLevels(const ViewSubject& in) {
  Painter p(in);
  p.findPatches();
  const auto levelOf = [&](size_t i) { return p.shape(i).isPlanar ? p.shape(i).level : 0; };
  const int most = std::max(1, p.largest(levelOf));
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const vec3 colour =
        p.shape(i).isPlanar
            ? colours::ramp(static_cast<float>(levelOf(i)) / static_cast<float>(most))
            : colours::kNoData;
    return outlined(p, s, i, shaded(colour, s));
  });
  out.legend = {"Patch halved",
                {{colours::kNoData, "not planar"}},
                colours::rampSteps(),
                "0 times",
                std::to_string(most) + " times"};
  return out;
}

ViewPicture occlusion(const ViewSubject& in) {
  const auto& lights = in.inspection.lights;
  const LightSample& light =
      lights[std::clamp<size_t>(static_cast<size_t>(in.chosenLight), 0, lights.size() - 1)];
  Painter p(in);
  p.findPatches();
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    if (!light.isLive) return outlined(p, s, i, shaded(colours::kNoData, s));
    const bool away = shared::vplGeometry(light.vpl, s.surface.position, s.normal,
                                          s.geometricNormal, 0.0f) == 0.0f;
    static constexpr std::array kStates = {colours::kNone, colours::kPartial, colours::kFull};
    const auto state =
        static_cast<size_t>(in.inspection.patches->state(s.hit->object, p.leaf(i), light.vpl.slot));
    return outlined(p, s, i, shaded(away ? colours::kAway : kStates[state], s));
  });
  out.legend.title = "Between the light sample and the patch";
  out.legend.swatches = {{colours::kNone, "nothing"},
                         {colours::kPartial, "something"},
                         {colours::kFull, "everything"},
                         {colours::kAway, "faces away"}};
  return out;
}

ViewPicture partialLights(const ViewSubject& in) {
  std::vector<size_t> slots;
  for (const LightSample& light : in.inspection.lights)
    if (light.isLive) slots.push_back(static_cast<size_t>(light.vpl.slot));
  Painter p(in);
  p.findPatches();
  std::vector<int> counts(p.pixels(), 0);
  p.forEachPixel([&](int x, int, size_t i) {
    if (!p.hit(i)) return;
    const uint32_t object = p.hit(i).object;
    if (x > 0 && p.hit(i - 1) && p.hit(i - 1).object == object && p.leaf(i - 1) == p.leaf(i)) {
      counts[i] = counts[i - 1];
      return;
    }
    const auto row = in.inspection.patches->states(object, p.leaf(i));
    counts[i] = static_cast<int>(std::count_if(slots.begin(), slots.end(), [&](size_t slot) {
      return row[slot] == static_cast<uint8_t>(Occlusion::partial);
    }));
  });
  const int most = std::min(colours::niceMaximum(p.largest([&](size_t i) { return counts[i]; })),
                            std::max(static_cast<int>(slots.size()), 1));
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const float t = static_cast<float>(counts[i]) / static_cast<float>(most);
    return outlined(p, s, i, shaded(colours::ramp(t), s));
  });
  out.legend = {"Light samples that may be shadowed",
                {},
                colours::rampSteps(),
                "0",
                std::to_string(most) + " of " + std::to_string(slots.size())};
  return out;
}

}  // namespace lamplighter::views
