#include "renderer/methods/stored_depth_parameters.h"

namespace lamplighter {

const ParameterTable<StoredDepthParameters>& storedDepthParameters() {
  using P = StoredDepthParameters;
  static const ParameterTable<P> table{
      {&P::texel,
       "texel",
       "Texel",
       "m",
       "Side of the texels that keep bounced light and what they see. Texels are larger where "
       "depth_memory is short.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::texelOrder,
       "texel_order",
       "Order of texels",
       "",
       "Along which texels depths are compressed. zigzag: row by row. spiral: along the border of "
       "a chart, then inwards. greedy: always the nearest texel.",
       {{"zigzag", TexelOrder::zigzag},
        {"spiral", TexelOrder::spiral},
        {"greedy", TexelOrder::greedy}}},
      {&P::depthMap,
       "depth_map",
       "Depth map",
       "",
       "How the directions around a texel are divided. cube: six faces. octahedral: one square.",
       {{"cube", DepthMapKind::cube}, {"octahedral", DepthMapKind::octahedral}}},
      {&P::depthResolution,
       "depth_resolution",
       "Depth resolution",
       "pixels",
       "Side of a depth map, or of a face of the cube.",
       {8, 128, kLogarithmic}},
      {&P::linkVisibility,
       "link_visibility",
       "Visibility",
       "",
       "How texels find out what they see when links are made. rays: exactly. stored: by their "
       "depths, as paper 3 has it; they are as coarse as the pixels of depth maps.",
       {{"stored", TexelVisibility::stored}, {"rays", TexelVisibility::rays}}},
      {&P::linkError,
       "link_error",
       "Link error",
       "%",
       "Surfaces that may fill more of the view of a texel are divided. Less: more links, more "
       "exact bounced light.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality,
       "Less: more exact bounced light."},
      {&P::depthMemory,
       "depth_memory",
       "Depth memory",
       "MiB",
       "Memory for depths and links, about. If it is short, texels are larger.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: smaller texels on large levels, down to texel."}};
  return table;
}

void StoredDepthStats::take(const TexelRadiosity& light) {
  const SurfaceDepths& depths = light.depths();
  texels = static_cast<int>(light.texels().size());
  texelSide = light.counts().texel;
  links = static_cast<int>(light.links().size());
  segments = static_cast<int>(depths.segments());
  if (segments > 0)
    ratio = static_cast<float>(depths.uncompressed()) / static_cast<float>(segments);
  progress = 100.0f * light.progress();
  texelRays = light.counts().rays;
  depthBytes = light.counts().bytes;
}

const StatisticTable<StoredDepthStats>& storedDepthStatistics() {
  using S = StoredDepthStats;
  static const StatisticTable<S> table{
      {&S::texels,
       {.name = "surface_texels",
        .label = "Texels",
        .unit = "texels",
        .meaning = "Texels of surface that keep bounced light."}},
      {&S::texelSide,
       {.name = "texel_side",
        .label = "Side of texels",
        .unit = "m",
        .meaning = "Side of the texels that memory allows.",
        .budget = "depth_memory",
        .cost = "texels of {}"}},
      {&S::segments,
       {.name = "depth_segments",
        .label = "Segments of depths",
        .unit = "segments",
        .meaning = "Segments of equal depths of consecutive texels."}},
      {&S::ratio,
       {.name = "depth_ratio",
        .label = "Pixels a segment",
        .unit = "pixels",
        .meaning = "Pixels of depth maps for which a segment stands: how well depths are "
                   "compressed."}},
      {&S::links,
       {.name = "links",
        .label = "Links",
        .unit = "links",
        .meaning = "Links by which texels receive light from surfaces."}},
      {&S::texelRays,
       {.name = "texel_rays",
        .label = "Rays of texels",
        .unit = "rays",
        .meaning = "Rays for depths and for the direct light of texels that were traced in this "
                   "frame.",
        .kind = StatisticKind::work}},
      {&S::progress,
       {.name = "prepared",
        .label = "Prepared",
        .unit = "%",
        .meaning = "Share of the depths and links of texels that is found. Until all are, bounced "
                   "light is missing, or that of before.",
        .kind = StatisticKind::pending,
        .status = "finding links {}",
        .shownFrom = 0.0,
        .shownBelow = 100.0}},
      {&S::depthBytes,
       {.name = "depth_bytes",
        .label = "Memory of depths and links",
        .unit = "bytes",
        .meaning = "Memory of depths, links and direct light of texels.",
        .budget = "depth_memory",
        .cost = "{}"}}};
  return table;
}

}  // namespace lamplighter
