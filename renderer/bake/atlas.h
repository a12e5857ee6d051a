// Light map atlas: the position of each chart of a scene on pages.
#pragma once

#include <vector>

#include "renderer/atlas/placed_chart.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct AtlasOptions {
  float texelsPerMetre = 8.0f;
  int pageSize = 1024;  // texels per side
};

// A chart of an object, in world space, with texels per unit of the scene.
struct ObjectChart : PlacedChart {
  uint32_t object = 0;  // index into RenderScene::objects
  int page = 0;
};

struct LightMapAtlas {
  int pageSize = 0, pages = 0;
  std::vector<ObjectChart> charts;  // ordered by object
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
