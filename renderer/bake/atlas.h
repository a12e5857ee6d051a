// Light map atlas: the position of each chart of a scene on pages.
#pragma once

#include <vector>

#include "renderer/bake/unwrap.h"

namespace lamplighter {

struct AtlasOptions {
  float texelsPerMetre = 8.0f;
  int pageSize = 1024;  // texels per side
};
// Width of the border around each chart [texels]. It belongs to the chart, so that filters do not
// read neighbouring charts.
inline constexpr int kGutter = 2;

struct PlacedChart {
  BakeChart chart;
  int page = 0;
  glm::ivec2 at{0}, size{0};  // on the page, including the gutter [texels]
  float texelsPerMetre = 1.0f;

  // Projects a point of the chart to the page [texels]. The centre of texel (0, 0) is (0.5, 0.5).
  // Row 0 is the top row, as in images.
  vec2 texelsOf(const vec3& p) const {
    return vec2(at + kGutter) + texelsPerMetre * (chart.project(p) - chart.min);
  }
};

struct LightMapAtlas {
  int pageSize = 0, pages = 0;
  std::vector<PlacedChart> charts;  // ordered by object
  struct Coarser {
    NodeId node = kNoNode;
    float texelsPerMetre = 0.0f;
  };
  std::vector<Coarser> coarser;  // nodes with reduced resolution, because a page cannot hold more
};

// Puts all charts of a node on one page. If they do not fit on an empty page, their resolution is
// reduced. Only surfaces of meshes get light maps: area lights and transparent panes do not. Throws
// InputError if the charts of a node fit on no page at any resolution.
LightMapAtlas makeAtlas(const RenderScene& scene, const AtlasOptions& options);

}  // namespace lamplighter
