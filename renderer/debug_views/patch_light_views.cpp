// Views of light counts per patch: the lights that reach it, those that are pending, and how much
// of one light reaches it.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::views {

namespace colours = view_colours;

namespace {

// A value for each pixel's patch; computed once for consecutive pixels with the same patch.
std::vector<int> ofPatches(const Painter& p,
                           const std::function<int(uint32_t object, int leaf)>& count) {
  std::vector<int> counts(p.pixels(), 0);
  p.forEachPixel([&](int x, int, size_t i) {
    if (!p.hit(i)) return;
    const uint32_t object = p.hit(i).object;
    const bool same =
        x > 0 && p.hit(i - 1) && p.hit(i - 1).object == object && p.leaf(i - 1) == p.leaf(i);
    counts[i] = same ? counts[i - 1] : count(object, p.leaf(i));
  });
  return counts;
}

// Colours from `zero` (if given) over the ramp up to the largest count.
ViewPicture paintCounts(const Painter& p, const std::vector<int>& counts, size_t of,
                        const char* title, const char* noneLabel) {
  const int most = std::min(colours::niceMaximum(p.largest([&](size_t i) { return counts[i]; })),
                            std::max(static_cast<int>(of), 1));
  constexpr float kFirst = 0.35f;  // skips the ramp's blue, which resembles the colour for zero
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const float t = static_cast<float>(counts[i]) / static_cast<float>(most);
    const vec3 colour = noneLabel == nullptr ? colours::ramp(t)
                        : counts[i] == 0     ? colours::kSettled
                                             : colours::ramp(glm::mix(kFirst, 1.0f, t));
    return outlined(p, s, i, shaded(colour, s));
  });
  out.legend.title = title;
  out.legend.ramp = colours::rampSteps(noneLabel == nullptr ? 0.0f : kFirst);
  out.legend.low = "0";
  out.legend.high = std::to_string(most) + " of " + std::to_string(of);
  if (noneLabel != nullptr) out.legend.swatches = {{colours::kSettled, noneLabel}};
  return out;
}

}  // namespace

ViewPicture lightsPerPatch(const ViewSubject& in) {
  std::vector<size_t> slots;
  for (const LightSample& light : in.inspection.lights)
    if (light.isLive) slots.push_back(static_cast<size_t>(light.vpl.slot));
  Painter p(in);
  p.findPatches();
  const std::vector<int> counts = ofPatches(p, [&](uint32_t object, int leaf) {
    const auto row = in.inspection.patches->states(object, leaf);
    return static_cast<int>(std::count_if(slots.begin(), slots.end(), [&](size_t slot) {
      return row[slot] != static_cast<uint8_t>(Occlusion::full);
    }));
  });
  return paintCounts(p, counts, slots.size(), "Light samples that reach the patch", nullptr);
}

ViewPicture pendingPatches(const ViewSubject& in) {
  const PatchView& patches = *in.inspection.patches;
  std::vector<const LightSample*> waiting;
  for (const LightSample& light : in.inspection.lights)
    if (light.isStale) waiting.push_back(&light);
  Painter p(in);
  p.findPatches();
  // A light that is not shown yet may reach everything.
  const std::vector<int> counts = ofPatches(p, [&](uint32_t object, int leaf) {
    return static_cast<int>(
        std::count_if(waiting.begin(), waiting.end(), [&](const LightSample* light) {
          return !light->isLive || patches.state(object, leaf, light->vpl.slot) != Occlusion::full;
        }));
  });
  return paintCounts(p, counts, in.inspection.lights.size(), "Light samples waited for",
                     "up to date");
}

ViewPicture lightOcclusion(const ViewSubject& in) {
  std::vector<const LightSample*> samples;
  for (const LightSample& light : in.inspection.lights)
    if (light.isLive && light.id.bounce == 0 && light.id.light == in.chosenNode)
      samples.push_back(&light);
  Painter p(in);
  p.findPatches();
  // Samples that face the pixel, and twice the visible ones among them: `partial` counts half.
  const auto shareAt = [&](const Seen& s, int leaf) {
    const auto states = in.inspection.patches->states(s.hit->object, leaf);
    int facing = 0, open = 0;
    for (const LightSample* light : samples) {
      if (shared::vplGeometry(light->vpl, s.surface.position, s.normal, s.geometricNormal, 0.0f) ==
          0.0f)
        continue;
      ++facing;
      const auto state = static_cast<Occlusion>(states[static_cast<size_t>(light->vpl.slot)]);
      open += state == Occlusion::none ? 2 : state == Occlusion::partial ? 1 : 0;
    }
    return facing == 0 ? -1.0f : 0.5f * static_cast<float>(open) / static_cast<float>(facing);
  };
  const auto colourOf = [&](float share) {
    if (share < 0.0f) return colours::kAway;
    return share < 0.5f ? glm::mix(colours::kFull, colours::kPartial, 2.0f * share)
                        : glm::mix(colours::kPartial, colours::kNone, 2.0f * share - 1.0f);
  };
  // The set of samples that face a flat patch changes slowly along it, and a sum over all of them
  // per pixel would be slow.
  constexpr int kRun = 4;
  std::vector<float> shares(p.pixels(), 0.0f);
  p.forEachPixel([&](int x, int, size_t i) {
    if (!p.hit(i)) return;
    const bool same = x % kRun != 0 && p.hit(i - 1) && p.hit(i - 1).object == p.hit(i).object &&
                      p.leaf(i - 1) == p.leaf(i) && p.shape(i).isPlanar;
    shares[i] = same ? shares[i - 1] : shareAt(p.seen(i), p.leaf(i));
  });
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const vec3 colour = samples.empty() ? colours::kNoData : colourOf(shares[i]);
    return outlined(p, s, i, shaded(colour, s));
  });
  out.legend.title = "Unoccluded share of the light";
  for (int i = 0; i <= 32; ++i) out.legend.ramp.push_back(colourOf(static_cast<float>(i) / 32.0f));
  out.legend.low = "none";
  out.legend.high = "all";
  out.legend.swatches = {{colours::kAway, "faces away"}};
  if (samples.empty()) out.legend.swatches.push_back({colours::kNoData, "it has no samples"});
  return out;
}

ViewPicture lightMapDensity(const ViewSubject& in) {
  const TexelView& texels = *in.inspection.texels;
  Painter p(in);
  if (in.inspection.patches) p.findPatches();
  // The larger of the two texel spacings, in tenths of a millimetre; 0: no texels.
  std::vector<int> apart(p.pixels(), 0);
  p.forEachPixel([&](int, int, size_t i) {
    if (!p.hit(i)) return;
    const auto grid = texels.gridAt(p.hit(i).object, p.hit(i).triangle, p.position(i));
    if (!grid) return;
    const vec2 size = grid->size / grid->cells;
    apart[i] = std::max(1, static_cast<int>(std::lround(1e4f * std::max(size.x, size.y))));
  });
  const int most = colours::niceMaximum(p.largest([&](size_t i) { return apart[i]; }));
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const float t = static_cast<float>(apart[i]) / static_cast<float>(most);
    const bool has = apart[i] > 0 && s.front;
    return outlined(p, s, i, shaded(has ? colours::ramp(t) : colours::kNoData, s));
  });
  out.legend.title = "Distance between light map texels";
  out.legend.ramp = colours::rampSteps();
  out.legend.low = "0";
  char text[32];
  std::snprintf(text, sizeof text, "%.3g cm", 0.01 * most);
  out.legend.high = text;
  out.legend.swatches = {{colours::kNoData, "no light map"}};
  return out;
}

ViewPicture prtObjects(const ViewSubject& in) {
  const Painter p(in);
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t) {
    static constexpr std::array kStates = {colours::kNoData, colours::kPartial, colours::kNone};
    return shaded(kStates[static_cast<size_t>(in.inspection.transfer(s.hit->object))], s);
  });
  out.legend.title = "Lit by precomputed transfer";
  out.legend.swatches = {
      {colours::kNone, "yes"}, {colours::kPartial, "being prepared"}, {colours::kNoData, "no"}};
  return out;
}

}  // namespace lamplighter::views
