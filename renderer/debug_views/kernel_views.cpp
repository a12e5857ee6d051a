// Frame data of the backend: shadow maps, and where light was interpolated.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/debug_views/debug_views.h"
#include "renderer/debug_views/painter.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::views {

namespace colours = view_colours;

namespace {

// Distance from the light to the content of a texel [m]; for directional light, from the near end
// of its box. 0: empty.
float distanceIn(const shared::Vpl& vpl, float stored, const vec2& centre) {
  if (stored <= 0.0f) return 0.0f;
  if (vpl.position.w == shared::kVplDirectional) return (1.0f - stored) * 2.0f * vpl.normal.w;
  return glm::length(shared::octahedralDecode(centre)) / stored;
}

}  // namespace

// The map as stored, as large as fits, in the middle of the view.
ViewPicture shadowMap(const ViewSubject& in) {
  const std::vector<float>& map = in.shadowMap;
  const auto resolution = static_cast<int>(std::lround(std::sqrt(static_cast<double>(map.size()))));
  const auto& lights = in.inspection.lights;
  const size_t chosen =
      std::min(static_cast<size_t>(std::max(in.chosenLight, 0)), lights.size() - 1);
  const shared::Vpl& vpl = lights[chosen].vpl;
  std::vector<float> distances(map.size());
  float most = 0.0f;
  for (size_t i = 0; i < map.size(); ++i) {
    const auto column = static_cast<float>(i % static_cast<size_t>(resolution)),
               row = static_cast<float>(i / static_cast<size_t>(resolution));
    const vec2 centre =
        shared::shadowTexelCentre(vec2(column, row), static_cast<float>(resolution));
    distances[i] = distanceIn(vpl, map[i], centre);
    most = std::max(most, distances[i]);
  }
  ViewPicture out;
  out.image = Image8(in.view.width, in.view.height);
  const int side = std::max(1, std::min(in.view.width, in.view.height) * 9 / 10);
  const int left = (in.view.width - side) / 2, top = (in.view.height - side) / 2;
  for (int y = 0; y < in.view.height; ++y) {
    for (int x = 0; x < in.view.width; ++x) {
      vec3 colour = colours::kBackground;
      if (x >= left && x < left + side && y >= top && y < top + side) {
        const auto column = static_cast<size_t>((x - left) * resolution / side),
                   row = static_cast<size_t>((y - top) * resolution / side);
        const float d = distances[row * static_cast<size_t>(resolution) + column];
        colour = d > 0.0f ? colours::ramp(1.0f - d / most) : colours::kAway;
      }
      for (int k = 0; k < 3; ++k)
        out.image.at(x, y)[k] = static_cast<uint8_t>(colour[k] * 255.0f + 0.5f);
    }
  }
  out.legend.title = "Shadow map of light sample " + std::to_string(chosen);
  out.legend.ramp = colours::rampSteps();
  char text[32];
  std::snprintf(text, sizeof text, "%.3g m", static_cast<double>(in.scene.unit * most));
  out.legend.low = text;
  out.legend.high = "0";
  out.legend.swatches = {{colours::kAway, "nothing"}};
  return out;
}

ViewPicture edgeMask(const ViewSubject& in) {
  const Painter p(in);
  ViewPicture out;
  out.image = p.paint([&](const Seen& s, size_t i) {
    const bool between = i < in.interpolated.size() && in.interpolated[i] != 0;
    return shaded(between ? colours::kSettled : colours::kPartial, s);
  });
  out.legend.title = "Light of the low-resolution pass";
  out.legend.swatches = {{colours::kPartial, "summed at each pixel"},
                         {colours::kSettled, "interpolated"}};
  return out;
}

}  // namespace lamplighter::views
