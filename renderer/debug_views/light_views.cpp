// Views of the light itself: light maps, and the age of the light.
#include <cmath>

#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"
#include "renderer/image/tone_map.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::views {

namespace colours = view_colours;

namespace {

// The share of a texel grid line in a pixel's colour; it fades where texels are too small to see.
float gridLine(const vec2& at, const vec2& texelsAPixel) {
  float line = 0.0f;
  for (int axis = 0; axis < 2; ++axis) {
    const float distance = std::abs(at[axis] - std::round(at[axis]));
    const float width = texelsAPixel[axis];
    const float fade = std::clamp(0.5f - 2.0f * width, 0.0f, 0.4f) / 0.4f;  // 0 below 4 pixels
    line = std::max(line, fade * std::clamp(1.0f - distance / std::max(width, 1e-6f), 0.0f, 1.0f));
  }
  return line;
}

}  // namespace

ViewPicture lightMaps(const ViewSubject& in) {
  const TexelView& texels = *in.inspection.texels;
  const Painter p(in);
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t) {
    const Hit& hit = *s.hit;
    const auto grid = s.front ? texels.gridAt(hit.object, hit.triangle, s.surface.position)
                              : std::optional<TexelView::Grid>();
    if (!grid) return shaded(colours::kNoData, s);
    const vec3 e = texels.irradianceAt(hit.object, hit.triangle, s.surface.position);
    const vec3 colour = toneMapPixel(e / kPi, in.exposureEv, in.toneMapper);
    // At a grazing angle a pixel covers more texels.
    const float covered = s.footprint / std::max(s.facing, 0.05f);
    const float line = gridLine(grid->at, 0.75f * covered * (grid->cells / grid->size));
    const vec3 lineColour = luminance(colour) > 0.35f ? vec3(0.0f) : vec3(1.0f);
    return glm::mix(colour, lineColour, 0.3f * line);
  });
  out.legend.title = "Light without shadows";
  out.legend.swatches = {{colours::kNoData, "no light map"}};
  return out;
}

namespace {

// Age of the light at a point [frames]: the mean over all lights that reach it, weighted by their
// unshadowed irradiance. The maximum would be less useful: some faint pending indirect light
// reaches everything.
class LightAge {
 public:
  LightAge(const Painter& painter, const Inspection& inspection)
      : painter_(painter), in_(inspection) {}

  float at(const Seen& s, size_t pixel) const {
    // The default of the light sums, so that one near indirect VPL does not dominate.
    constexpr float kClampDistance = 0.5f;  // [m]
    std::span<const uint8_t> states;
    if (in_.patches) states = in_.patches->states(s.hit->object, painter_.leaf(pixel));
    float all = 0.0f, aged = 0.0f;
    for (const LightSample& light : in_.lights) {
      if (in_.patches && light.isLive &&
          static_cast<Occlusion>(states[static_cast<size_t>(light.vpl.slot)]) == Occlusion::full)
        continue;
      const float given = luminance(light.vpl.intensity) *
                          shared::vplGeometry(light.vpl, s.surface.position, s.normal,
                                              s.geometricNormal, kClampDistance);
      all += given;
      if (light.isStale) aged += given * static_cast<float>(light.framesWaiting);
    }
    return all > 0.0f ? aged / all : 0.0f;
  }

 private:
  const Painter& painter_;
  const Inspection& in_;
};

// By pixel. Each value is a sum over all lights, so it is computed for one pixel in 4×4 and reused
// by its neighbours on the same surface.
std::vector<float> lightAges(const Painter& p, const ViewSubject& in) {
  std::vector<float> ages(p.pixels(), 0.0f);
  const auto& lights = in.inspection.lights;
  if (std::none_of(lights.begin(), lights.end(), [](const auto& l) { return l.isStale; }))
    return ages;
  const LightAge age(p, in.inspection);
  const auto pixelOf = [&](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(in.view.width) + static_cast<size_t>(x);
  };
  constexpr int kCell = 4;
  const auto middleOf = [&](int x, int y) {
    return pixelOf(std::min(x / kCell * kCell + kCell / 2, in.view.width - 1),
                   std::min(y / kCell * kCell + kCell / 2, in.view.height - 1));
  };
  p.forEachPixel([&](int x, int y, size_t i) {
    if (p.hit(i) && middleOf(x, y) == i) ages[i] = age.at(p.seen(i), i);
  });
  std::vector<float> all = ages;
  p.forEachPixel([&](int x, int y, size_t i) {
    const size_t middle = middleOf(x, y);
    if (!p.hit(i) || middle == i) return;
    const Seen s = p.seen(i);
    constexpr float kSame = 0.97f;
    const bool same = p.hit(middle) && p.hit(middle).object == p.hit(i).object &&
                      glm::dot(p.seen(middle).normal, s.normal) > kSame;
    all[i] = same ? ages[middle] : age.at(s, i);
  });
  return all;
}

}  // namespace

ViewPicture mapAge(const ViewSubject& in) {
  Painter p(in);
  if (in.inspection.patches) p.findPatches();
  const std::vector<float> ages = lightAges(p, in);
  const int most = colours::niceMaximum(
      p.largest([&](size_t i) { return static_cast<int>(std::ceil(ages[i])); }));
  // Skips the ramp's blue, which resembles the colour of settled light.
  constexpr float kFirst = 0.35f;
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    if (ages[i] == 0.0f) return shaded(colours::kSettled, s);
    const float t = ages[i] / static_cast<float>(most);
    return shaded(colours::ramp(glm::mix(kFirst, 1.0f, t)), s);
  });
  out.legend = {"Age of the light",
                {{colours::kSettled, "up to date"}},
                colours::rampSteps(kFirst),
                "0",
                std::to_string(most) + (most == 1 ? " frame" : " frames")};
  return out;
}

}  // namespace lamplighter::views
