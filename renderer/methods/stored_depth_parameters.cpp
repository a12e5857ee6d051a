#include "renderer/methods/stored_depth_parameters.h"

namespace lamplighter {

const ParameterTable<StoredDepthParameters>& storedDepthParameters() {
  using P = StoredDepthParameters;
  static const ParameterTable<P> table{
      {&P::texel,
       "texel",
       "Texel",
       "m",
       "Side of the texels that store bounced light and its links. Half the side: four times the "
       "texels, more memory and time. Texels are larger if depth_memory is too small.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality},
      {&P::texelOrder,
       "texel_order",
       "Order of texels",
       "",
       "Order of the texels along which depths are compressed. zigzag: row by row. spiral: along "
       "the border of a chart, then inwards. greedy: always the nearest texel; its time grows with "
       "the square of the number of texels of an object. The orders differ by about a tenth in the "
       "memory of depths.",
       {{"zigzag", TexelOrder::zigzag},
        {"spiral", TexelOrder::spiral},
        {"greedy", TexelOrder::greedy}}},
      {&P::depthMap,
       "depth_map",
       "Depth map",
       "",
       "Mapping of the directions around a texel to pixels. cube: six squares. octahedral: one "
       "square. At the same depth_resolution the cube has six times the pixels, rays and memory. "
       "No effect with link_visibility=rays.",
       {{"cube", DepthMapKind::cube}, {"octahedral", DepthMapKind::octahedral}}},
      {&P::depthResolution,
       "depth_resolution",
       "Depth resolution",
       "pixels",
       "Side of a depth map, or of a face of the cube. Larger: more exact visibility; twice the "
       "side costs four times the rays and about four times the memory of depths. No effect with "
       "link_visibility=rays.",
       {8, 128, kLogarithmic}},
      {&P::linkVisibility,
       "link_visibility",
       "Visibility",
       "",
       "How the visibility of links is tested. rays: exact, up to four rays for each link. stored: "
       "by the stored depths of texels, as in paper 3; as coarse as the pixels of depth maps, "
       "needs memory for depths and more time to prepare, and after an object has moved all depths "
       "and links are computed again.",
       {{"stored", TexelVisibility::stored}, {"rays", TexelVisibility::rays}}},
      {&P::linkError,
       "link_error",
       "Link error",
       "%",
       "Largest share of the view of a texel that one link may cover. Smaller: more links, more "
       "exact bounced light, more memory.",
       {0.02, 10.0, kLogarithmic},
       ParameterGroup::quality,
       "Smaller: more exact bounced light."},
      {&P::depthMemory,
       "depth_memory",
       "Depth memory",
       "MiB",
       "Approximate memory for depths and links. If it is too small, texels are larger.",
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
        .meaning = "Surface texels that store bounced light."}},
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
        .label = "Pixels per segment",
        .unit = "pixels",
        .meaning =
            "Pixels of depth maps that one segment represents: the compression ratio of depths."}},
      {&S::links,
       {.name = "links",
        .label = "Links",
        .unit = "links",
        .meaning = "Links along which texels receive light from surfaces."}},
      {&S::texelRays,
       {.name = "texel_rays",
        .label = "Rays of texels",
        .unit = "rays",
        .meaning =
            "Rays that were traced in this frame for depths, links and the direct light of texels.",
        .kind = StatisticKind::work}},
      {&S::progress,
       {.name = "prepared",
        .label = "Prepared",
        .unit = "%",
        .meaning = "Share of the depths and links of texels that is computed. Below 100%, bounced "
                   "light is missing or outdated.",
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
