// Where the light map of each part of a scene lies: pages of charts.
#pragma once

#include <vector>

#include "renderer/bake/unwrap.h"

namespace lamplighter {

struct AtlasOptions {
  float texelsPerMetre = 8.0f;
  int pageSize = 1024;  // texels a side
};
// Texels around each chart that belong to it, so that filters do not reach its neighbours.
inline constexpr int kGutter = 2;

struct PlacedChart {
  BakeChart chart;
  int page = 0;
  glm::ivec2 at{0}, size{0};  // on the page, gutter included [texels]
  float texelsPerMetre = 1.0f;

  // A point of the chart on the page; the centre of texel (0, 0) is at (0.5, 0.5). Row 0 is the
  // top, as in images.
  vec2 texelsOf(const vec3& p) const {
    return vec2(at + kGutter) + texelsPerMetre * (chart.project(p) - chart.min);
  }
};

struct LightMapAtlas {
  int pageSize = 0, pages = 0;
  std::vector<PlacedChart> charts;  // by object
  struct Coarser {
    NodeId node = kNoNode;
    float texelsPerMetre = 0.0f;
  };
  std::vector<Coarser> coarser;  // nodes of which a page holds no more
};

// All charts of a node are on one page; what would not fit on an empty one is made coarser. Light
// maps are for the surfaces of meshes: not for area lights, nor for panes that light passes.
// Throws InputError when a node's charts fit on no page however coarse they are.
LightMapAtlas makeAtlas(const RenderScene& scene, const AtlasOptions& options);

}  // namespace lamplighter
