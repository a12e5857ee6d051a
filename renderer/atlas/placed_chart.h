// Charts as rectangles of texels on a page.
#pragma once

#include <span>

#include "renderer/atlas/skyline.h"
#include "renderer/atlas/unwrap.h"

namespace lamplighter {

// Width of the border around each chart [texels]. It belongs to the chart, so that filters do not
// read neighbouring charts.
inline constexpr int kGutter = 2;

struct PlacedChart {
  MeshChart chart;
  glm::ivec2 at{0}, size{0};  // on the page, including the gutter [texels]
  float texelsPerMetre = 1.0f;

  // Projects a point of the chart to the page [texels]. The centre of texel (0, 0) is (0.5, 0.5).
  // Row 0 is the top row, as in images.
  vec2 texelsOf(const vec3& p) const {
    return vec2(at + kGutter) + texelsPerMetre * (chart.project(p) - chart.min);
  }
};

// Sets the resolution and the size of a chart; at least one texel besides the gutter.
void setDensity(PlacedChart& chart, float texelsPerMetre);

// Places charts on the page, tall ones first. If they do not all fit, it returns false and the page
// is unchanged.
bool placeOn(Skyline& page, std::span<PlacedChart* const> charts);

}  // namespace lamplighter
